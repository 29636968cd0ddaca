// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"
#include "signorini/discretization/discretization.h"
#include "signorini/physics/batched_force.h"
#include "signorini/physics/cell_kernel.h"
#include "signorini/physics/force_term.h"

#include <variant>
#include <vector>

namespace signorini
{
/// The elastic forces of all bodies. Where bodies yield they are those of the step since commit() was last
/// called, whose energy contains its plastic work; nothing else changes what the points remember.
template <int dim>
class InternalForce : public ForceTerm
{
public:
  InternalForce(const std::vector<MaterialParameters> &materials, const Discretization<dim> &discretization);

  void update(const State &state) override;

  /// From the next update() on everything speaks of the middle between `start` and the present displacement,
  /// and the energy is twice that of the middle: its gradient by the present displacement is the force there.
  /// Null: of the present displacement again. `start` must outlive its use.
  void set_step_start(const Vector *start) { step_start = start; }
  double energy() const override;
  void add_force(Vector &force) const override;
  /// Linear elasticity's, unless forces are those of a step.
  bool has_constant_tangent() const override { return step_start == nullptr && !is_nonlinear(); }
  void add_tangent(TangentSystem &system) const override;

  /// The row-major tangent of every one of these own cells, as `visit(cell, tangent)`.
  void for_each_tangent(const std::vector<unsigned int> &cells,
                        const std::function<void(unsigned int, const std::vector<double> &)> &visit) const;

  /// Adds to every local and ghost entry the sum of the magnitudes that its force is the small difference of:
  /// what round-off is relative to [N].
  void add_magnitudes(Vector &magnitudes) const;

  /// True stress at every quadrature point of an own cell, [point] [Pa].
  std::vector<Eigen::Matrix3d> point_stresses(unsigned int cell) const;

  /// Makes the state of the last update() the one that further yielding starts from. Returns the work done in
  /// yielding since the last call, of all ranks together [J; J/m in 2-D] (collective). With a step start that
  /// is the state in the middle of the step.
  double commit();

  /// What all points remember, to be carried to another mesh, and taken there: J2Plastic::memory() at the
  /// last update(), zero in bodies that do not yield; nothing where none does.
  PointValues memory() const;
  void remember(const PointValues &memory);

  /// Whether any body may yield.
  bool has_plasticity() const;

  /// Mean equivalent plastic strain of every own cell; 0 in bodies that do not yield.
  std::vector<double> plastic_strains() const;

  /// The largest rotation of any own cell, its mean, of each body whose law takes it for a strain [rad]; 0 of
  /// the others.
  std::vector<double> turns_taken_for_strain() const;

  /// Whether the tangent depends on the deformation.
  bool is_nonlinear() const;

  /// Mean of H + Hᵀ + HᵀH over every own cell, twice Green's strain: a rigid motion leaves it at zero.
  std::vector<typename BatchedForce<dim>::Stretch> stretches() const;

  /// Mean true stress of every own cell [Pa].
  std::vector<Eigen::Matrix3d> stresses() const;

  /// What points that have yielded remember, for boost's archives.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &plastic_states;
  }

private:
  using PlasticKernel = CellKernel<dim, J2Plastic<dim>>;
  static constexpr unsigned int n_remembered = std::tuple_size_v<typename J2Plastic<dim>::Memory>;
  using Kernel =
      std::variant<CellKernel<dim, LinearElastic<dim>>, CellKernel<dim, NeoHookean<dim>>, PlasticKernel>;

  void make_plastic_states();

  /// Calls `action(kernel, cell, geometry, u)` for every own cell, u its nodal displacements.
  template <typename Action>
  void for_each_cell(const Action &action) const;

  /// The same for one cell, with `u` as scratch memory.
  template <typename Action>
  void with_cell(unsigned int cell, std::vector<double> &u, const Action &action) const;

  const Discretization<dim> *discretization;
  const Vector *displacement = nullptr; ///< that everything speaks of
  const Vector *step_start = nullptr;
  Vector middle;                            ///< of the step
  std::vector<double> moduli;               ///< of compression without widening, κ + 4μ/3, one a body [Pa]
  mutable std::vector<Kernel> kernels;      ///< one a body; mutable for their scratch memory
  BatchedForce<dim> batched;                ///< the forces of most bodies
  std::vector<unsigned int> single_cells;   ///< own ones of the others
  std::vector<PlasticState> plastic_states; ///< of all points of own cells of bodies that may yield
  std::vector<std::size_t>
      first_plastic_states; ///< [own cell] and the end; empty where no body of any rank may yield
};
} // namespace signorini
