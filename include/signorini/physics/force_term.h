// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/physics/state.h"

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <string>

namespace signorini
{
/// What contact adds to tangents. With depth d and stiffness k a point's energy ½ k d² has the Hessian
/// k (∇d∇dᵀ + d ∇∇d), whose second part may be negative: far from equilibrium, where bodies lie deep in each
/// other, by more than all that holds them.
enum class ContactTangent
{
  exact,
  convex ///< k ∇d∇dᵀ alone
};

/// A linear system for an increment of the displacement, with the constraints to assemble it under.
struct TangentSystem
{
  const dealii::AffineConstraints<double> *constraints = nullptr;
  dealii::TrilinosWrappers::SparseMatrix matrix;
  ContactTangent contact_tangent = ContactTangent::exact;
  dealii::TrilinosWrappers::MPI::Vector right_hand_side; ///< receives what inhomogeneous constraints bring
};

/// A force that derives from an energy.
class ForceTerm
{
public:
  enum class Kind
  {
    elastic, ///< stored in the bodies
    contact, ///< stored in penetrations
    load     ///< a given force; its energy is minus the work it can do
  };

  ForceTerm(std::string term_name, Kind term_kind, bool is_an_external_term)
      : name(std::move(term_name)), kind(term_kind), is_external(is_an_external_term)
  {
  }
  virtual ~ForceTerm() = default;
  ForceTerm(const ForceTerm &) = delete;
  ForceTerm &operator=(const ForceTerm &) = delete;

  /// Renews what is kept from earlier states, such as neighbours (collective). Returns by how much the energy
  /// at this very state changed by it [J].
  virtual double renew(const State &) { return 0.; }

  /// How often neighbours were searched, also within update(): couplings may differ after each.
  virtual unsigned int n_searches() const { return 0; }

  /// Prepares for the positions of `state` (collective). The functions below speak of this state.
  virtual void update(const State &state) = 0;

  /// Energy of all ranks together [J; J/m in 2-D] (collective).
  virtual double energy() const = 0;

  /// Adds minus the gradient of the energy to local and ghost entries; the caller collects.
  virtual void add_force(Vector &force) const = 0;

  /// Adds the couplings of the tangent beyond those within cells.
  virtual void add_couplings(const dealii::AffineConstraints<double> &,
                             dealii::TrilinosWrappers::SparsityPattern &) const
  {
  }

  /// Whether the Hessian is the same at all states.
  virtual bool has_constant_tangent() const { return false; }

  /// Adds the Hessian of the energy.
  virtual void add_tangent(TangentSystem &) const {}

  const std::string name;
  const Kind kind;
  const bool is_external; ///< whether it may change the momentum of the scene
};
} // namespace signorini
