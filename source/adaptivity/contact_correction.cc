// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/contact_correction.h"

#include "signorini/contact/geometry/facet_shape.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace signorini
{
template <int dim>
ContactCorrection<dim>::ContactCorrection(const Discretization<dim> &the_discretization,
                                          const Scene<dim> &the_scene, const SceneForces<dim> &scene_forces,
                                          const SurfaceMap<dim> &surface_map,
                                          const std::vector<BoundaryFace<dim>> &boundary_faces)
    : scene(&the_scene), forces(&scene_forces), map(&surface_map), discretization(&the_discretization),
      recovery(the_discretization), faces(&boundary_faces),
      current(scene_forces.surface_contacts.size(), NodalPressures<dim>(surface_map.surface().facets.size()))
{
}

template <int dim>
double ContactCorrection<dim>::normal_pressure(const BoundaryFace<dim> &face, unsigned int node,
                                               const Eigen::Matrix3d &stress,
                                               const std::vector<SpatialVector<dim>> &positions) const
{
  SpatialVector<dim> normal = face.normals[node];
  double stretch = 1.;
  if (scene->materials[face.body].model != MaterialParameters::Model::linear_elastic)
  {
    // True stress acts on the deformed face.
    const Facet<dim> &facet = map->surface().facets[face.facet];
    const LocalPoint<dim> xi = contact::node_coordinates(facet, face.facet_nodes[node]);
    const auto area_normal = [&](const std::vector<SpatialVector<dim>> &x)
    { return contact::evaluate_facet_frame(contact::gather_nodes(facet, x), xi).area_normal; };
    const SpatialVector<dim> deformed = area_normal(positions);
    normal = deformed.normalized();
    stretch = deformed.norm() / area_normal(map->surface().reference_positions).norm();
  }
  return -stretch * normal.dot(stress.topLeftCorner<dim, dim>() * normal);
}

template <int dim>
double ContactCorrection<dim>::update(const State &state)
{
  const std::vector<SpatialVector<dim>> positions = map->positions(state.displacement);
  recovery.recover(*forces->elasticity);
  std::vector<NodalPressures<dim>> pressures;
  for (const auto &contact : forces->surface_contacts)
    pressures.push_back(contact->facet_pressures());
  double largest_change = 0., largest = 0.;
  unsigned int cell = static_cast<unsigned int>(-1);
  std::vector<Eigen::Matrix3d> nodal;
  for (const BoundaryFace<dim> &face : *faces)
  {
    if (std::exchange(cell, face.cell) != face.cell)
      nodal = recovery.nodal_stresses(face.cell);
    for (unsigned int i = 0; i < face.nodes.size(); ++i)
    {
      const unsigned int node = face.facet_nodes[i];
      double sum = 0.;
      for (const NodalPressures<dim> &of_term : pressures)
        sum += of_term[face.facet][node];
      const double wanted = std::max(0., normal_pressure(face, i, nodal[face.nodes[i]], positions));
      for (unsigned int term = 0; term < pressures.size(); ++term)
      {
        // Where two terms press on one face, each has its share; without contact a stress means nothing.
        const double share = sum > 0. ? pressures[term][face.facet][node] / sum : 0.;
        double &multiplier = current[term][face.facet][node];
        largest_change = std::max(largest_change, std::abs(share * wanted - multiplier));
        multiplier = share * wanted;
        largest = std::max(largest, multiplier);
      }
    }
  }
  set(current);
  largest = dealii::Utilities::MPI::max(largest, discretization->communicator());
  largest_change = dealii::Utilities::MPI::max(largest_change, discretization->communicator());
  return largest > 0. ? largest_change / largest : 0.;
}

template <int dim>
void ContactCorrection<dim>::set(Multipliers multipliers)
{
  current = std::move(multipliers);
  for (unsigned int term = 0; term < current.size(); ++term)
    forces->surface_contacts[term]->set_multipliers(current[term]);
}

template class ContactCorrection<2>;
template class ContactCorrection<3>;
} // namespace signorini
