// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/error_estimator.h"

#include "signorini/discretization/scene_mesh.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <functional>
#include <numeric>

namespace signorini
{
template <int dim>
ErrorEstimator<dim>::ErrorEstimator(const Discretization<dim> &the_discretization,
                                    const Scene<dim> &the_scene, const SceneForces<dim> &scene_forces,
                                    const SurfaceMap<dim> *surface_map)
    : discretization(&the_discretization), scene(&the_scene), forces(&scene_forces), map(surface_map),
      recovery(the_discretization), faces(collect_boundary_faces(the_discretization, surface_map))
{
}

template <int dim>
SpatialVector<dim> ErrorEstimator<dim>::load_traction(const BoundaryFace<dim> &face, unsigned int node,
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
void ErrorEstimator<dim>::balance_tractions(const BoundaryFace<dim> &face, double time,
                                            const NodalPressures<dim> &pressures,
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
NodalPressures<dim> ErrorEstimator<dim>::contact_pressures() const
{
  NodalPressures<dim> sum(map != nullptr ? map->surface().facets.size() : 0);
  for (const auto &contact : forces->surface_contacts)
  {
    const NodalPressures<dim> pressures = contact->facet_pressures();
    for (unsigned int f = 0; f < pressures.size(); ++f)
      for (unsigned int i = 0; i < pressures[f].size(); ++i)
        sum[f][i] += pressures[f][i];
  }
  return sum;
}

template <int dim>
double ErrorEstimator<dim>::squared_error(unsigned int cell, const std::vector<Eigen::Matrix3d> &nodal) const
{
  const MaterialParameters &material = scene->materials[discretization->cells.bodies[cell]];
  const double nu = material.poissons_ratio;
  double sum = 0.;
  for (const auto &[difference, volume] :
       recovery.differences(cell, nodal, forces->elasticity->point_stresses(cell)))
  {
    const double trace = difference.trace();
    sum += volume / material.youngs_modulus * ((1. + nu) * difference.squaredNorm() - nu * trace * trace);
  }
  return sum;
}

template <int dim>
void ErrorEstimator<dim>::find_unseen_contact(const State &state, ErrorEstimate &result) const
{
  result.is_contact_unseen.assign(discretization->cells.n_cells, false);
  bool is_any = false;
  for (const auto &contact : forces->surface_contacts)
  {
    const std::vector<unsigned int> unseen = contact->unseen_contact(state, 0.);
    for (const BoundaryFace<dim> &face : faces)
      if (std::binary_search(unseen.begin(), unseen.end(), face.facet))
        is_any = result.is_contact_unseen[face.cell] = true;
  }
  result.is_any_contact_unseen =
      dealii::Utilities::MPI::max(static_cast<int>(is_any), discretization->communicator()) == 1;
}

template <int dim>
std::vector<bool> ErrorEstimator<dim>::find_unknown_tractions() const
{
  std::vector<bool> is_unknown(faces.size(), false);
  const auto &partitioner = *discretization->node_positions.get_partitioner();
  for (const auto &contact : forces->volume_contacts)
  {
    const auto in_contact = contact->faces_in_contact();
    for (unsigned int f = 0; f < faces.size(); ++f)
    {
      std::vector<dealii::types::global_dof_index> dofs;
      for (const unsigned int node : faces[f].nodes)
        dofs.push_back(
            partitioner.local_to_global(discretization->cells.cell_dofs(faces[f].cell)[node * dim]));
      std::sort(dofs.begin(), dofs.end());
      is_unknown[f] = in_contact.count(dofs) > 0;
    }
  }
  return is_unknown;
}

template <int dim>
void ErrorEstimator<dim>::add_contact_errors(ErrorEstimate &result) const
{
  result.cell_contact.assign(discretization->cells.n_cells, 0.);
  for (const auto &contact : forces->surface_contacts)
  {
    const std::vector<double> errors = contact->facet_errors();
    for (const BoundaryFace<dim> &face : faces)
      result.cell_contact[face.cell] += errors[face.facet];
  }
  for (const auto &contact : forces->volume_contacts)
  {
    const std::vector<double> errors = contact->cell_errors();
    std::transform(errors.begin(), errors.end(), result.cell_contact.begin(), result.cell_contact.begin(),
                   std::plus<>());
  }
  const double sum = std::accumulate(result.cell_contact.begin(), result.cell_contact.end(), 0.);
  result.contact = dealii::Utilities::MPI::sum(sum, discretization->communicator());
}

template <int dim>
ErrorEstimate ErrorEstimator<dim>::estimate(const State &state)
{
  const unsigned int n_cells = discretization->cells.n_cells;
  const NodalPressures<dim> pressures = contact_pressures();
  recovery.recover(*forces->elasticity);
  const std::vector<bool> is_traction_unknown = find_unknown_tractions();
  ErrorEstimate result;
  unsigned int f = 0;
  for (unsigned int cell = 0; cell < n_cells; ++cell)
  {
    std::vector<Eigen::Matrix3d> nodal = recovery.nodal_stresses(cell);
    for (; f < faces.size() && faces[f].cell == cell; ++f)
      if (!is_traction_unknown[f])
        balance_tractions(faces[f], state.time, pressures, nodal);
    result.cell_discretization.push_back(squared_error(cell, nodal));
    result.discretization += result.cell_discretization.back();
  }
  result.discretization = dealii::Utilities::MPI::sum(result.discretization, discretization->communicator());
  add_contact_errors(result);
  find_unseen_contact(state, result);
  result.energy = 2. * forces->elasticity->energy();
  return result;
}

template class ErrorEstimator<2>;
template class ErrorEstimator<3>;
} // namespace signorini
