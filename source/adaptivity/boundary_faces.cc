// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/boundary_faces.h"

#include "signorini/base/to_eigen.h"

#include <deal.II/fe/fe_values.h>

#include <algorithm>

namespace signorini
{
namespace
{
template <int dim>
void collect_of_part(const MeshPart<dim> &part, std::vector<BoundaryFace<dim>> &faces)
{
  const dealii::FiniteElement<dim> &element = part.element.base_element(0);
  const dealii::Quadrature<dim - 1> at_nodes(element.get_unit_face_support_points());
  dealii::FEFaceValues<dim> values(part.mapping(), element, at_nodes,
                                   dealii::update_values | dealii::update_normal_vectors |
                                       dealii::update_quadrature_points);
  unsigned int own_cell = part.first_cell;
  for (const auto &cell : part.own_cells())
  {
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary())
      {
        values.reinit(typename dealii::Triangulation<dim>::cell_iterator(cell), f);
        BoundaryFace<dim> face;
        face.cell = own_cell;
        face.body = cell->material_id();
        face.boundary_id = cell->face(f)->boundary_id();
        for (unsigned int q = 0; q < at_nodes.size(); ++q)
        {
          face.normals.push_back(to_eigen(values.normal_vector(q)));
          face.positions.push_back(values.quadrature_point(q));
          for (unsigned int a = 0; a < element.n_dofs_per_cell(); ++a)
            if (values.shape_value(a, q) > 0.5)
              face.nodes.push_back(a);
        }
        faces.push_back(std::move(face));
      }
    ++own_cell;
  }
}

/// Finds the facets of the contact surface, which was collected in the same order.
template <int dim>
void join_facets(const Discretization<dim> &discretization, const SurfaceMap<dim> &map,
                 std::vector<BoundaryFace<dim>> &faces)
{
  const ContactSurface<dim> &surface = map.surface();
  const Vector layout = discretization.make_vector();
  auto face = faces.begin();
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
  {
    const Facet<dim> &facet = surface.facets[f];
    if (!facet.owned)
      continue;
    face->facet = f;
    for (const unsigned int a : face->nodes)
    {
      const unsigned int local = discretization.cells.cell_dofs(face->cell)[a * dim];
      const auto dof = layout.get_partitioner()->local_to_global(local);
      const auto begin = facet.nodes.begin(), end = begin + facet.n_nodes();
      const auto found =
          std::find_if(begin, end, [&](unsigned int node) { return map.node_dofs(node)[0] == dof; });
      AssertThrow(found != end, dealii::ExcInternalError());
      face->facet_nodes.push_back(static_cast<unsigned int>(found - begin));
    }
    ++face;
  }
}
} // namespace

template <int dim>
std::vector<BoundaryFace<dim>> collect_boundary_faces(const Discretization<dim> &discretization,
                                                      const SurfaceMap<dim> *map)
{
  std::vector<BoundaryFace<dim>> faces;
  for (const MeshPart<dim> *part : discretization.parts)
    collect_of_part(*part, faces);
  if (map != nullptr)
    join_facets(discretization, *map, faces);
  return faces;
}

template std::vector<BoundaryFace<2>> collect_boundary_faces(const Discretization<2> &,
                                                             const SurfaceMap<2> *);
template std::vector<BoundaryFace<3>> collect_boundary_faces(const Discretization<3> &,
                                                             const SurfaceMap<3> *);
} // namespace signorini
