// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/types.h"
#include "signorini/discretization/cell_table.h"
#include "signorini/discretization/hexahedral_part.h"
#include "signorini/discretization/point_transfer.h"
#include "signorini/discretization/tetrahedral_part.h"
#include "signorini/parameters/parameters.h"

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <array>
#include <functional>
#include <memory>

namespace signorini
{
/// A hanging degree of freedom and those it hangs between, as indices into the local part of a Vector.
struct HangingDof
{
  unsigned int dof = 0;
  std::vector<std::pair<unsigned int, double>> masters;
};

/// A node whose degrees of freedom this rank owns.
template <int dim>
struct OwnedNode
{
  std::array<unsigned int, dim> dofs; ///< local indices
  dealii::Point<dim> position;        ///< undeformed [m]
  unsigned int body = 0;
};

/// Meshes, elements, degrees of freedom and hanging nodes of all bodies of a scene. Own cells are numbered
/// part by part, in the order of MeshPart::own_cells(), hexahedra first.
template <int dim>
class Discretization
{
public:
  Discretization(const Parameters &parameters, const MPI_Comm &communicator);

  /// Refines and coarsens the hexahedra by their flags, numbers everything anew and carries `values` and
  /// `point_values` over by interpolation (collective). Whatever was made from this object before is void.
  /// New cells stay on the rank that had those they came from.
  void adapt(const std::vector<Vector *> &values, PointValues &point_values);

  /// Puts other meshes in the place of those of the tetrahedra, the same ones on every rank, numbers
  /// everything anew and carries `values` over by interpolation (collective). Whatever was made from this
  /// object before is void.
  void replace_tetrahedra(const std::vector<PlacedSimplexMesh> &meshes, const std::vector<Vector *> &values);

  /// Largest sum of `weights`, of own cells, of any rank over the mean of all ranks (collective).
  double imbalance(const std::vector<unsigned int> &weights) const;

  /// Shares the hexahedra out among the ranks anew, so that each has about the same sum of their `weights`,
  /// positive ones of its own cells, and carries `values` and `point_values` over as they are (collective).
  /// Tetrahedra, which stay on their ranks, count for nothing. Does nothing where no rank has more than 1.1
  /// of the mean. Returns whether it did; then whatever was made from this object before is void.
  bool balance(const std::vector<unsigned int> &weights, const std::vector<Vector *> &values,
               PointValues &point_values);

  /// Ids of this rank's hexahedra, from which restore() makes the same mesh again.
  std::vector<dealii::CellId::binary_type> hexahedron_ids() const;

  /// Refines and coarsens the hexahedra of the file's mesh until every rank has those with these ids of its
  /// own, in the order of hexahedron_ids(), and numbers everything anew (collective). Whatever was made from
  /// this object before is void. Throws FileError if that mesh cannot become these.
  void restore(const std::vector<dealii::CellId::binary_type> &ids);

  /// A zero vector with ghost entries for all that this rank's cells need.
  Vector make_vector() const;

  /// Sets hanging degrees of freedom to their interpolated values and updates ghosts.
  void distribute(Vector &values) const;

  /// Turns forces added cell by cell on local and ghost entries into forces on their owners' free degrees of
  /// freedom: the transpose of distribute().
  void collect(Vector &forces) const;

  /// Calls `visit(part, cell, own_cell)` for every own cell.
  template <typename Visit>
  void for_each_own_cell(const Visit &visit) const
  {
    unsigned int own_cell = 0;
    for (MeshPart<dim> *part : parts)
      for (const auto &cell : part->own_cells())
        visit(*part, cell, own_cell++);
  }

  const unsigned int degree;                        ///< of all elements
  std::unique_ptr<HexahedralPart<dim>> hexahedra;   ///< null in scenes without
  std::unique_ptr<TetrahedralPart<dim>> tetrahedra; ///< null in scenes without
  std::vector<MeshPart<dim> *> parts;               ///< those that there are

  /// Undeformed positions of the nodes, as a vector of degrees of freedom; hanging ones between their
  /// masters, also on curved boundaries [m].
  Vector node_positions;

  dealii::IndexSet owned_dofs;
  dealii::IndexSet relevant_dofs; ///< includes the masters of all hanging nodes
  dealii::AffineConstraints<double> hanging_constraints;
  std::vector<HangingDof> hanging_dofs; ///< of all relevant ones
  CellTable<dim> cells;
  std::vector<OwnedNode<dim>> owned_nodes;

  /// Owned degrees of freedom without a cell: deal.II 9.4 numbers a few of them on the borders between ranks
  /// of meshes with hanging nodes. They mean nothing and must not reach a linear solver.
  std::vector<dealii::types::global_dof_index> unused_dofs;

  /// Adds the entries of a matrix that couple the degrees of freedom of an own cell.
  void add_couplings(const dealii::AffineConstraints<double> &constraints,
                     dealii::TrilinosWrappers::SparsityPattern &pattern) const;

  /// Degrees of freedom of all ranks that have a cell.
  dealii::types::global_dof_index n_dofs() const;

  /// Cells of all ranks.
  dealii::types::global_cell_index n_cells() const;

  const MPI_Comm &communicator() const { return mpi_communicator; }

private:
  void set_up();
  /// This part's own values of some vectors, [vector].
  static std::vector<Vector> extract(const MeshPart<dim> &part, const std::vector<Vector *> &values);
  /// Forgets all that depends on the meshes, numbers them and makes the vectors new.
  void set_up_anew(const std::vector<Vector *> &values);
  /// Numbers everything anew after `change` of the hexahedra's mesh and carries the values over.
  void change_mesh(const std::vector<Vector *> &values, PointValues &point_values,
                   const std::function<void()> &change);
  void change_mesh(const std::vector<Vector *> &values, const std::function<void()> &change);
  void number_dofs();
  void set_numbering();
  void number_hanging_dofs();
  void place_nodes();
  void fill_cell_table();
  void add_cells(MeshPart<dim> &part);
  void check_cells() const;
  void collect_owned_nodes();

  MPI_Comm mpi_communicator;
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
};
} // namespace signorini
