// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/body_mesh.h"

#include "signorini/base/to_point.h"
#include "signorini/parameters/mesh_parameters.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <cmath>

namespace signorini
{
namespace
{
template <int dim>
void make_box(const MeshParameters &parameters, dealii::Triangulation<dim> &mesh)
{
  const std::vector<unsigned int> cells(parameters.cells.begin(), parameters.cells.begin() + dim);
  dealii::GridGenerator::subdivided_hyper_rectangle(mesh, cells, to_point<dim>(parameters.lower_corner),
                                                    to_point<dim>(parameters.upper_corner), true);
}

/// Turns the first axis into the last one, as a proper rotation.
template <int dim>
dealii::Point<dim> turn_first_axis_to_last(const dealii::Point<dim> &x)
{
  dealii::Point<dim> turned = x;
  turned[0] = -x[dim - 1];
  turned[dim - 1] = x[0];
  return turned;
}

template <int dim>
void make_ball(const MeshParameters &parameters, dealii::Triangulation<dim> &mesh)
{
  switch (parameters.part)
  {
  case MeshParameters::Part::whole:
    dealii::GridGenerator::hyper_ball(mesh, dealii::Point<dim>(), parameters.radius);
    break;
  case MeshParameters::Part::half:
    dealii::GridGenerator::half_hyper_ball(mesh, dealii::Point<dim>(), parameters.radius);
    dealii::GridTools::transform(turn_first_axis_to_last<dim>, mesh);
    break;
  case MeshParameters::Part::orthant:
    dealii::GridGenerator::quarter_hyper_ball(mesh, dealii::Point<dim>(), parameters.radius);
    break;
  }
}

template <int dim>
void make_cylinder(const MeshParameters &parameters, dealii::Triangulation<dim> &mesh)
{
  dealii::GridGenerator::cylinder(mesh, parameters.radius, 0.5 * parameters.length);
  dealii::GridTools::transform(turn_first_axis_to_last<dim>, mesh);
}

/// Gives every outer face the boundary it lies on: the one all its vertices are nearest to.
template <int dim>
void name_curved_shape(const MeshParameters &parameters, dealii::Triangulation<dim> &mesh)
{
  // Not only the objects but the numbers too: deal.II leaves 1 on the outer cells of a ball.
  mesh.reset_all_manifolds();
  mesh.set_all_manifold_ids(dealii::numbers::flat_manifold_id);
  const std::vector<std::string> names = boundary_names(parameters, dim);
  for (const auto &face : mesh.active_face_iterators())
    if (face->at_boundary())
      for (unsigned int id = names.size(); id-- > 0;)
      {
        double farthest = 0.;
        for (const unsigned int v : face->vertex_indices())
          farthest = std::max(farthest, distance_to_boundary(parameters, names[id], face->vertex(v)));
        if (farthest < 1e-10 * parameters.radius)
        {
          face->set_boundary_id(id);
          if (id == 0)
            face->set_all_manifold_ids(0);
        }
      }
}
} // namespace

template <int dim>
void make_coarse_body_mesh(const MeshParameters &parameters, dealii::Triangulation<dim> &mesh)
{
  switch (parameters.shape)
  {
  case MeshParameters::Shape::box:
    make_box(parameters, mesh);
    return;
  case MeshParameters::Shape::ball:
    make_ball(parameters, mesh);
    break;
  case MeshParameters::Shape::cylinder:
    make_cylinder(parameters, mesh);
    break;
  case MeshParameters::Shape::file:
    AssertThrow(false, dealii::ExcMessage("a mesh from a file has no hexahedra"));
  }
  name_curved_shape(parameters, mesh);
}

template <int dim>
double distance_to_boundary(const MeshParameters &parameters, const std::string &boundary,
                            const dealii::Point<dim> &own)
{
  const std::vector<std::string> names = boundary_names(parameters, dim);
  const auto id = static_cast<unsigned int>(std::find(names.begin(), names.end(), boundary) - names.begin());
  AssertIndexRange(id, names.size());
  switch (parameters.shape)
  {
  case MeshParameters::Shape::box:
    return std::abs(own[id / 2] - (id % 2 == 0 ? parameters.lower_corner : parameters.upper_corner)[id / 2]);
  case MeshParameters::Shape::ball:
    return id == 0 ? std::abs(own.norm() - parameters.radius) : std::abs(own[boundary[0] - 'x']);
  case MeshParameters::Shape::cylinder:
    break;
  case MeshParameters::Shape::file:
    AssertThrow(false, dealii::ExcMessage("only SurfaceDistance knows the boundaries of a file"));
  }
  if (id == 0)
    return std::abs(std::hypot(own[0], own[1]) - parameters.radius);
  return std::abs(own[dim - 1] - (id == 1 ? -0.5 : 0.5) * parameters.length);
}

template void make_coarse_body_mesh<2>(const MeshParameters &, dealii::Triangulation<2> &);
template void make_coarse_body_mesh<3>(const MeshParameters &, dealii::Triangulation<3> &);
template double distance_to_boundary<2>(const MeshParameters &, const std::string &,
                                        const dealii::Point<2> &);
template double distance_to_boundary<3>(const MeshParameters &, const std::string &,
                                        const dealii::Point<3> &);
} // namespace signorini
