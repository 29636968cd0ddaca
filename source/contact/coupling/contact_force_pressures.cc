// SPDX-License-Identifier: LGPL-2.1-or-later
// What a ContactForce tells of pressures at nodes.
#include "signorini/contact/coupling/contact_force.h"

#include <deal.II/base/mpi.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <map>
#include <set>

namespace signorini
{
namespace
{
template <int dim>
double undeformed_area(const Facet<dim> &facet, const ContactSurface<dim> &surface)
{
  const auto nodes = contact::gather_nodes(facet, surface.reference_positions);
  double area = 0.;
  for (const auto &point : contact::make_gauss_points<dim>(facet.type, 3))
    area += point.weight * contact::evaluate_facet_frame(nodes, point.xi).area_normal.norm();
  return area;
}

/// One number for each corner of a facet.
template <int dim>
using Corners = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 1 << (dim - 1), 1>;

/// The (bi)linear functions of a facet, each 1 at one of its corners.
template <int dim>
Corners<dim> corner_functions(const FacetType type, const LocalPoint<dim> &xi)
{
  FacetElement<dim> element;
  element.type = type;
  const auto shape = contact::evaluate_facet_shape(element, xi);
  return Eigen::Map<const Corners<dim>>(shape.value.data(), shape.n_nodes);
}

/// The coefficients of these functions in the L2 projection of a function whose integrals with them are
/// `moments`, over a facet of the given area.
template <int dim>
Corners<dim> project_on_corners(const FacetType type, const Corners<dim> &moments, const double area)
{
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(moments.size(), moments.size());
  double measure = 0.;
  for (const auto &point : contact::make_gauss_points<dim>(type, 2))
  {
    const Corners<dim> corners = corner_functions<dim>(type, point.xi);
    mass += point.weight * corners * corners.transpose();
    measure += point.weight;
  }
  return mass.llt().solve(moments) * measure / area;
}

/// The middle nodes of the sides of quadratic triangles, with the ends of the sides; none in two dimensions.
template <int dim>
std::map<unsigned int, std::array<unsigned int, 2>> find_triangle_middles(const ContactSurface<dim> &surface)
{
  std::map<unsigned int, std::array<unsigned int, 2>> middles;
  if constexpr (dim == 3)
    for (const Facet<dim> &facet : surface.facets)
      for (unsigned int side = 0; side < 3 && facet.type == FacetType::triangle && facet.degree == 2; ++side)
        middles[facet.nodes[3 + side]] = {facet.nodes[side], facet.nodes[(side + 1) % 3]};
  return middles;
}
} // namespace

template <int dim>
std::vector<SpatialVector<dim>> ContactForce<dim>::nodal_forces() const
{
  std::vector<SpatialVector<dim>> forces(map.surface().n_nodes(), SpatialVector<dim>::Zero());
  potential.add_forces(forces);
  return forces;
}

template <int dim>
std::vector<double> ContactForce<dim>::nodal_areas() const
{
  // A point counts once however many surfaces it is near.
  std::set<std::pair<unsigned int, std::array<double, dim - 1>>> known;
  std::vector<double> areas(map.surface().n_nodes(), 0.);
  for (const contact::ContactSample<dim> &sample : potential.samples())
  {
    std::array<double, dim - 1> xi;
    std::copy(sample.xi.begin(), sample.xi.end(), xi.begin());
    if (!known.emplace(sample.facet, xi).second)
      continue;
    const Facet<dim> &facet = map.surface().facets[sample.facet];
    const auto shape = contact::evaluate_facet_shape(facet, sample.xi);
    for (unsigned int i = 0; i < facet.n_nodes(); ++i)
      areas[facet.nodes[i]] += shape.value[i] * sample.full_area;
  }
  return areas;
}

template <int dim>
std::vector<std::optional<double>> ContactForce<dim>::nodal_pressures() const
{
  const ContactSurface<dim> &surface = map.surface();
  std::vector<SpatialVector<dim>> forces = nodal_forces();
  std::vector<double> areas = nodal_areas();
  const auto middles = find_triangle_middles(surface);
  for (const auto &[middle, ends] : middles)
    for (const unsigned int end : ends)
    {
      forces[end] += 0.5 * forces[middle];
      areas[end] += 0.5 * areas[middle];
    }
  map.sum(forces);
  map.sum(areas);
  const double largest_area = dealii::Utilities::MPI::max(
      areas.empty() ? 0. : *std::max_element(areas.begin(), areas.end()), this->communicator);
  std::vector<std::optional<double>> pressures(surface.n_nodes());
  for (unsigned int node = 0; node < surface.n_nodes(); ++node)
    if (areas[node] > 1e-9 * largest_area)
      pressures[node] = forces[node].norm() / areas[node];
  for (const auto &[middle, ends] : middles)
    if (pressures[middle])
      pressures[middle] = 0.5 * (*pressures[ends[0]] + *pressures[ends[1]]);
  return pressures;
}

template <int dim>
std::vector<double> ContactForce<dim>::projected_pressures() const
{
  const ContactSurface<dim> &surface = map.surface();
  const NodalPressures<dim> of_facets = facet_pressures();
  std::vector<double> forces(surface.n_nodes(), 0.), areas(surface.n_nodes(), 0.);
  for (unsigned int f = 0; f < of_facets.size(); ++f)
  {
    const Facet<dim> &facet = surface.facets[f];
    const auto end = of_facets[f].begin() + facet.n_nodes();
    if (std::all_of(of_facets[f].begin(), end, [](double pressure) { return pressure == 0.; }))
      continue; // where contact ends, as on a cut, its last faces count alone
    const double area = undeformed_area(facet, surface);
    for (unsigned int i = 0; i < facet.n_nodes(); ++i)
    {
      forces[facet.nodes[i]] += area * of_facets[f][i];
      areas[facet.nodes[i]] += area;
    }
  }
  map.sum(forces);
  map.sum(areas);
  std::vector<double> pressures;
  for (unsigned int node = 0; node < surface.n_nodes(); ++node)
    pressures.push_back(areas[node] > 0. ? forces[node] / areas[node] : 0.);
  return pressures;
}

template <int dim>
NodalPressures<dim> ContactForce<dim>::facet_pressures() const
{
  const ContactSurface<dim> &surface = map.surface();
  NodalPressures<dim> pressures(map.n_own_facets());
  std::vector<Corners<dim>> moments(pressures.size()); // ∫ p N dA, of facets that have samples
  for (const contact::ContactSample<dim> &sample : potential.samples())
  {
    const Corners<dim> corners = corner_functions<dim>(surface.facets[sample.facet].type, sample.xi);
    Corners<dim> &sum = moments[sample.facet];
    if (sum.size() == 0)
      sum.setZero(corners.size());
    sum += sample.full_area * sample.pressure * corners;
  }
  for (unsigned int f = 0; f < pressures.size(); ++f)
  {
    const Facet<dim> &facet = surface.facets[f];
    pressures[f].fill(0.);
    if (moments[f].size() == 0)
      continue;
    const Corners<dim> corners =
        project_on_corners<dim>(facet.type, moments[f], undeformed_area(facet, surface));
    for (unsigned int i = 0; i < facet.n_nodes(); ++i)
      pressures[f][i] =
          std::max(0., corners.dot(corner_functions<dim>(facet.type, contact::node_coordinates(facet, i))));
  }
  return pressures;
}

template std::vector<SpatialVector<2>> ContactForce<2>::nodal_forces() const;
template std::vector<double> ContactForce<2>::nodal_areas() const;
template std::vector<std::optional<double>> ContactForce<2>::nodal_pressures() const;
template std::vector<double> ContactForce<2>::projected_pressures() const;
template NodalPressures<2> ContactForce<2>::facet_pressures() const;
template std::vector<SpatialVector<3>> ContactForce<3>::nodal_forces() const;
template std::vector<double> ContactForce<3>::nodal_areas() const;
template std::vector<std::optional<double>> ContactForce<3>::nodal_pressures() const;
template std::vector<double> ContactForce<3>::projected_pressures() const;
template NodalPressures<3> ContactForce<3>::facet_pressures() const;
} // namespace signorini
