// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/mesh_part.h"
#include "signorini/mesh/simplex_mesh.h"
#include "signorini/parameters/parameters.h"

#include <deal.II/distributed/fully_distributed_tria.h>

namespace signorini
{
/// A body's mesh of simplices, placed in the scene.
struct PlacedSimplexMesh
{
  unsigned int body = 0;
  SimplexMesh mesh;

  template <typename Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive &body &mesh;
  }
};

/// The bodies of tetrahedra (triangles), shared out among the ranks once and for all.
template <int dim>
class TetrahedralPart : public MeshPart<dim>
{
public:
  /// Every rank gives the same meshes.
  TetrahedralPart(const std::vector<PlacedSimplexMesh> &meshes, unsigned int degree,
                  const MPI_Comm &communicator);

  /// Middle nodes of curved edges where the mesh has them, of others halfway.
  std::vector<dealii::Point<dim>> place_nodes(const typename MeshPart<dim>::Cell &cell) override;
  /// Symmetric, of degree `element.degree`: one point, or as many as the simplex has corners.
  dealii::Quadrature<dim> cell_rule() const override;
  /// Exact: the diagonal of the consistent mass matrix, scaled to the volume, is positive for quadratic cells
  /// too, unlike its row sums (E. Hinton, T. Rock, O. C. Zienkiewicz, 1976).
  dealii::Quadrature<dim> lumping_rule() const override;

private:
  using Mesh = dealii::parallel::fullydistributed::Triangulation<dim>;
  using Edge = std::pair<unsigned int, unsigned int>;

  /// Of all bodies in one numbering.
  struct CoarseMesh
  {
    std::vector<dealii::Point<dim>> vertices;
    std::vector<dealii::CellData<dim>> cells;
    dealii::SubCellData faces;
    std::map<Edge, dealii::Point<dim>> edge_midpoints;

    explicit CoarseMesh(const std::vector<PlacedSimplexMesh> &meshes);
    void append(const PlacedSimplexMesh &placed);
  };

  TetrahedralPart(const CoarseMesh &coarse, unsigned int degree, const MPI_Comm &communicator);
  TetrahedralPart(std::unique_ptr<Mesh> mesh, const CoarseMesh &coarse, unsigned int degree);
  static std::unique_ptr<Mesh> share_out(const CoarseMesh &coarse, const MPI_Comm &communicator);

  /// Of the curved edges of this rank's cells: [coarse cell][line of the cell].
  std::map<std::pair<dealii::types::coarse_cell_id, unsigned int>, dealii::Point<dim>> curved_edges;
};
} // namespace signorini
