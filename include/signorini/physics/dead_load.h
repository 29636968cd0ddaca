// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/discretization.h"
#include "signorini/physics/force_term.h"
#include "signorini/scene/scene.h"

namespace signorini
{
/// How a body's weight is shared among its nodes.
enum class WeightShares
{
  shape_integrals, ///< ∫N dV: as the virtual work of gravity has it
  lumped_mass      ///< as the mass of explicit runs, so that all nodes fall alike
};

/// Weight and tractions: forces that do not depend on the displacement, only on time.
template <int dim>
class DeadLoad : public ForceTerm
{
public:
  DeadLoad(const Scene<dim> &scene, const Discretization<dim> &discretization, WeightShares shares);

  void update(const State &state) override;
  /// −f·u: the work that the present forces could have done.
  double energy() const override;
  void add_force(Vector &force) const override;

private:
  /// A quadrature point of a loaded face.
  struct LoadedPoint
  {
    unsigned int load;
    dealii::Point<dim> position;
    std::vector<std::pair<unsigned int, double>> weights; ///< local dof of component 0 … and ∫N dA share
    std::vector<unsigned int> components;
  };

  void add_weight(WeightShares shares);
  void collect_points();
  void collect_points_of(const MeshPart<dim> &part,
                         const std::multimap<dealii::types::boundary_id, unsigned int> &loaded);
  void add_own_tractions(double time);

  const Scene<dim> *scene;
  const Discretization<dim> *discretization;
  std::vector<LoadedPoint> points;
  Vector weight; ///< gravity's share, on free dofs
  Vector forces; ///< at the time of the last update
  double work = 0.;
};
} // namespace signorini
