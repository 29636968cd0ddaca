// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/discretization.h"
#include "signorini/scene/scene.h"

namespace signorini
{
/// The degrees of freedom that supports prescribe. Every rank knows all of them.
template <int dim>
class SupportedDofs
{
public:
  struct Entry
  {
    dealii::types::global_dof_index dof;
    unsigned int support; ///< index into Scene::supports
    dealii::Point<dim> position;
  };

  /// Throws InputError where two supports contradict each other, at t = 0 or at `end_time`.
  SupportedDofs(const Scene<dim> &scene, const Discretization<dim> &discretization, double end_time);

  const std::vector<Entry> &entries() const { return all; }
  double value(const Entry &entry, double t) const;

  /// Sets the owned supported entries of `displacement` to their values at time t.
  void impose(double t, Vector &displacement) const;

  /// Zeroes the owned supported entries.
  void clear(Vector &forces) const;

  /// Local indices of the owned ones.
  const std::vector<unsigned int> &owned_dofs() const { return owned; }

private:
  const Scene<dim> *scene;
  std::vector<Entry> all;
  std::vector<unsigned int> owned;         ///< local indices
  std::vector<unsigned int> owned_entries; ///< their indices in `all`
};
} // namespace signorini
