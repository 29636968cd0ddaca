// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/error_estimator.h"

#include "signorini/base/to_eigen.h"
#include "signorini/discretization/scene_mesh.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>

namespace signorini
{
template <int dim>
ErrorEstimator<dim>::ErrorEstimator(const Discretization<dim> &the_discretization,
                                    const Scene<dim> &the_scene, const SceneForces<dim> &scene_forces,
                                    const SurfaceMap<dim> *surface_map)
    : discretization(&the_discretization), scene(&the_scene), forces(&scene_forces), map(surface_map),
      recovery(the_discretization)
{
  collect_boundary_faces();
  if (map)
    join_facets();
}

template <int dim>
void ErrorEstimator<dim>::collect_boundary_faces()
{
  const auto &element = discretization->element;
  const dealii::QGaussLobatto<dim - 1> at_nodes(element.degree + 1);
  dealii::FEFaceValues<dim> values(discretization->mapping, element, at_nodes,
                                   dealii::update_values | dealii::update_normal_vectors |
                                       dealii::update_quadrature_points);
  unsigned int own_cell = 0;
  for (const auto &cell : discretization->dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary())
      {
        values.reinit(cell, f);
        BoundaryFace face;
        face.cell = own_cell;
        face.body = cell->material_id();
        face.boundary_id = cell->face(f)->boundary_id();
        for (unsigned int q = 0; q < at_nodes.size(); ++q)
        {
          face.normals.push_back(to_eigen(values.normal_vector(q)));
          face.positions.push_back(values.quadrature_point(q));
          for (unsigned int a = 0; a < discretization->cells.n_nodes; ++a)
            if (values.shape_value(element.component_to_system_index(0, a), q) > 0.5)
              face.nodes.push_back(a);
        }
        faces.push_back(std::move(face));
      }
    ++own_cell;
  }
}

template <int dim>
void ErrorEstimator<dim>::join_facets()
{
  // The contact surface was collected in the same order.
  const ContactSurface<dim> &surface = map->surface();
  const Vector layout = discretization->make_vector();
  auto face = faces.begin();
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
  {
    const Facet<dim> &facet = surface.facets[f];
    if (!facet.owned)
      continue;
    face->facet = f;
    for (const unsigned int a : face->nodes)
    {
      const unsigned int local = discretization->cells.cell_dofs(face->cell)[a * dim];
      const auto dof = layout.get_partitioner()->local_to_global(local);
      const auto begin = facet.nodes.begin(), end = begin + facet.n_nodes();
      const auto found =
          std::find_if(begin, end, [&](unsigned int node) { return map->node_dofs(node)[0] == dof; });
      AssertThrow(found != end, dealii::ExcInternalError());
      face->facet_nodes.push_back(static_cast<unsigned int>(found - begin));
    }
    ++face;
  }
}

template <int dim>
SpatialVector<dim> ErrorEstimator<dim>::load_traction(const BoundaryFace &face, unsigned int node,
                                                      double time) const
{
  SpatialVector<dim> traction = SpatialVector<dim>::Zero();
  for (const Load<dim> &load : scene->loads)
    if (global_boundary_id(load.body, load.boundary_id) == face.boundary_id)
      for (unsigned int d = 0; d < dim; ++d)
        traction[d] += evaluate(load.traction[d], load.description, face.positions[node], time);
  return traction;
}

template <int dim>
void ErrorEstimator<dim>::balance_tractions(const BoundaryFace &face, double time,
                                            const FacetPressures &pressures,
                                            std::vector<Eigen::Matrix3d> &nodal) const
{
  std::array<bool, dim> is_supported{};
  for (const Support<dim> &support : scene->supports)
    if (global_boundary_id(support.body, support.boundary_id) == face.boundary_id)
      is_supported[support.component] = true;
  for (unsigned int i = 0; i < face.nodes.size(); ++i)
  {
    Eigen::Matrix3d &stress = nodal[face.nodes[i]];
    SpatialVector<dim> traction = load_traction(face, i, time);
    if (map)
      traction -= pressures[face.facet][face.facet_nodes[i]] * face.normals[i];
    Eigen::Vector3d normal = Eigen::Vector3d::Zero(), missing = Eigen::Vector3d::Zero();
    normal.head<dim>() = face.normals[i];
    missing.head<dim>() = traction - (stress * normal).template head<dim>();
    for (unsigned int d = 0; d < dim; ++d)
      if (is_supported[d])
        missing[d] = 0.;
    stress += missing * normal.transpose() + normal * missing.transpose() -
              missing.dot(normal) * normal * normal.transpose();
  }
}

template <int dim>
typename ErrorEstimator<dim>::FacetPressures ErrorEstimator<dim>::gather_pressures() const
{
  FacetPressures sum;
  for (const auto &contact : forces->contacts)
  {
    const FacetPressures pressures = contact->facet_pressures();
    sum.resize(pressures.size());
    for (unsigned int f = 0; f < pressures.size(); ++f)
      for (unsigned int i = 0; i < pressures[f].size(); ++i)
        sum[f][i] += pressures[f][i];
  }
  return sum;
}

template <int dim>
double ErrorEstimator<dim>::squared_error(unsigned int cell, const std::vector<Eigen::Matrix3d> &nodal,
                                          const Eigen::Matrix3d *point_stresses) const
{
  const CellTable<dim> &cells = discretization->cells;
  const MaterialParameters &material = scene->materials[cells.bodies[cell]];
  const double nu = material.poissons_ratio;
  double sum = 0.;
  for (unsigned int q = 0; q < cells.n_points; ++q)
  {
    const Eigen::Matrix3d difference = recovery.interpolate(nodal, q) - point_stresses[q];
    const double trace = difference.trace();
    sum += cells.cell_weights(cell)[q] / material.youngs_modulus *
           ((1. + nu) * difference.squaredNorm() - nu * trace * trace);
  }
  return sum;
}

template <int dim>
void ErrorEstimator<dim>::find_unseen_contact(const State &state, ErrorEstimate &result) const
{
  result.is_contact_unseen.assign(discretization->cells.n_cells, false);
  bool is_any = false;
  for (const auto &contact : forces->contacts)
  {
    const std::vector<unsigned int> unseen = contact->unseen_contact(state);
    for (const BoundaryFace &face : faces)
      if (std::binary_search(unseen.begin(), unseen.end(), face.facet))
        is_any = result.is_contact_unseen[face.cell] = true;
  }
  result.is_any_contact_unseen =
      dealii::Utilities::MPI::max(static_cast<int>(is_any), discretization->communicator()) == 1;
}

template <int dim>
ErrorEstimate ErrorEstimator<dim>::estimate(const State &state)
{
  const unsigned int n_cells = discretization->cells.n_cells, n_points = discretization->cells.n_points;
  const std::vector<Eigen::Matrix3d> point_stresses = forces->elasticity->point_stresses();
  const FacetPressures pressures = gather_pressures();
  recovery.recover(point_stresses);
  ErrorEstimate result;
  result.cell_contact.assign(n_cells, 0.);
  auto face = faces.begin();
  for (unsigned int cell = 0; cell < n_cells; ++cell)
  {
    std::vector<Eigen::Matrix3d> nodal = recovery.nodal_stresses(cell);
    for (; face != faces.end() && face->cell == cell; ++face)
      balance_tractions(*face, state.time, pressures, nodal);
    result.cell_discretization.push_back(squared_error(cell, nodal, &point_stresses[cell * n_points]));
    result.discretization += result.cell_discretization.back();
  }
  for (const auto &contact : forces->contacts)
  {
    const std::vector<double> errors = contact->facet_errors();
    for (const BoundaryFace &of_face : faces)
      result.cell_contact[of_face.cell] += errors[of_face.facet];
  }
  for (const double squared : result.cell_contact)
    result.contact += squared;
  find_unseen_contact(state, result);
  result.discretization = dealii::Utilities::MPI::sum(result.discretization, discretization->communicator());
  result.contact = dealii::Utilities::MPI::sum(result.contact, discretization->communicator());
  result.energy = 2. * forces->elasticity->energy();
  return result;
}

template class ErrorEstimator<2>;
template class ErrorEstimator<3>;
} // namespace signorini
