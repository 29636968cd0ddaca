// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/potential/volume_potential.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace signorini::contact
{
namespace
{
/// Gap over the skin below which a pair counts as touching in the tangent.
constexpr double verge_over_skin = 1e-8;

/// Throws unless settings and simplices make sense; returns the skin.
template <int dim>
double check_and_measure_skin(const ContactVolume<dim> &volume, const VolumePotentialSettings &settings)
{
  if (!(settings.penalty_factor > 0.))
    throw std::invalid_argument(
        fmt::format("The penalty factor must be positive, but is {}.", settings.penalty_factor));
  if (!(settings.skin_over_height > 0.))
    throw std::invalid_argument(
        fmt::format("The skin must be positive, but is {} heights.", settings.skin_over_height));
  double height = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < volume.simplices.size(); ++i)
  {
    const Simplex<dim> &simplex = volume.simplices[i];
    if (!(simplex.height > 0.) || !(simplex.layer_thickness > 0.) || !(simplex.youngs_modulus > 0.))
      throw std::invalid_argument(fmt::format(
          "Simplex {} needs a positive height, layer thickness and Young's modulus, but has {}, {} and {}.",
          i, simplex.height, simplex.layer_thickness, simplex.youngs_modulus));
    height = std::min(height, simplex.height);
  }
  return volume.simplices.empty() ? 1. : settings.skin_over_height * height;
}

template <int dim>
SimplexSearch<dim> make_search(const ContactVolume<dim> &volume, double skin,
                               const VolumePotentialSettings &settings)
{
  const auto is_allowed = [excluded = settings.excluded_body_pairs](unsigned int body, unsigned int other)
  {
    return std::find(excluded.begin(), excluded.end(), std::pair(body, other)) == excluded.end() &&
           std::find(excluded.begin(), excluded.end(), std::pair(other, body)) == excluded.end();
  };
  return SimplexSearch<dim>(volume, skin, is_allowed);
}
} // namespace

template <int dim>
VolumePotential<dim>::VolumePotential(const ContactVolume<dim> &contact_volume,
                                      VolumePotentialSettings potential_settings)
    : volume(contact_volume), settings(std::move(potential_settings)),
      skin(check_and_measure_skin(volume, settings)), search(make_search(volume, skin, settings)),
      shapes(volume.simplices.size()), has_pair(volume.simplices.size(), false)
{
}

template <int dim>
double VolumePotential<dim>::update(const Positions &positions)
{
  if (search.is_stale(positions))
  {
    search.rebuild(positions);
    has_pair.assign(volume.simplices.size(), false);
    for (const auto &[first, second] : search.pairs())
      has_pair[first] = has_pair[second] = true;
    overlaps.clear();
  }
  return 0.;
}

template <int dim>
void VolumePotential<dim>::evaluate(const Positions &positions)
{
  const Positions vertex_positions = volume.vertex_positions(positions);
  for (std::size_t i = 0; i < shapes.size(); ++i)
    if (has_pair[i])
    {
      std::array<SpatialVector<dim>, dim + 1> x;
      for (unsigned int a = 0; a <= dim; ++a)
        x[a] = vertex_positions[volume.simplices[i].vertices[a]];
      shapes[i] = make_simplex_shape<dim>(x);
    }
  overlaps.clear();
  for (unsigned int pair = 0; pair < search.pairs().size(); ++pair)
    if (const auto state = make_pair(pair).evaluate())
      overlaps.push_back({pair, *state});
}

template <int dim>
const Simplex<dim> &VolumePotential<dim>::simplex(unsigned int pair, unsigned int side) const
{
  return volume.simplices[side == 0 ? search.pairs()[pair].first : search.pairs()[pair].second];
}

template <int dim>
unsigned int VolumePotential<dim>::vertex(unsigned int pair, unsigned int index) const
{
  return simplex(pair, index / (dim + 1)).vertices[index % (dim + 1)];
}

template <int dim>
double VolumePotential<dim>::stiffness(unsigned int pair) const
{
  const Simplex<dim> &first = simplex(pair, 0), &second = simplex(pair, 1);
  return settings.penalty_factor /
         (first.layer_thickness / first.youngs_modulus + second.layer_thickness / second.youngs_modulus);
}

template <int dim>
SimplexPair<dim> VolumePotential<dim>::make_pair(unsigned int pair) const
{
  const auto &[first, second] = search.pairs()[pair];
  const double half = .5 * stiffness(pair);
  return {{&shapes[first], &shapes[second]},
          {half * simplex(pair, 0).height, half * simplex(pair, 1).height}};
}

template <int dim>
double VolumePotential<dim>::energy() const
{
  double sum = 0.;
  for (const Overlap &overlap : overlaps)
    sum += overlap.state.energy;
  return sum;
}

template <int dim>
void VolumePotential<dim>::add_forces(std::vector<SpatialVector<dim>> &forces) const
{
  for (const Overlap &overlap : overlaps)
    for (unsigned int p = 0; p < SimplexPair<dim>::n_vertices; ++p)
      volume.for_each_node(vertex(overlap.pair, p), [&](unsigned int node, double weight)
                           { forces[node] += weight * overlap.state.forces[p]; });
}

template <int dim>
template <typename Vertices>
std::vector<unsigned int> VolumePotential<dim>::collect_nodes(const Vertices &vertices) const
{
  std::vector<unsigned int> nodes;
  for (const unsigned int v : vertices)
    volume.for_each_node(v, [&](unsigned int node, double) { nodes.push_back(node); });
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

template <int dim>
std::vector<unsigned int> VolumePotential<dim>::nodes_of(unsigned int pair) const
{
  std::array<unsigned int, SimplexPair<dim>::n_vertices> vertices;
  for (unsigned int p = 0; p < vertices.size(); ++p)
    vertices[p] = vertex(pair, p);
  return collect_nodes(vertices);
}

template <int dim>
void VolumePotential<dim>::for_each_tangent(
    const std::function<void(const std::vector<unsigned int> &nodes, const Eigen::MatrixXd &block)> &add)
    const
{
  typename SimplexPair<dim>::Tangent tangent;
  Eigen::MatrixXd block;
  std::array<std::vector<std::pair<Eigen::Index, double>>, SimplexPair<dim>::n_vertices>
      places; // and weights
  for (unsigned int pair = 0; pair < search.pairs().size(); ++pair)
  {
    if (!make_pair(pair).compute_tangent(verge_over_skin * skin, tangent))
      continue;
    const std::vector<unsigned int> nodes = nodes_of(pair);
    for (unsigned int p = 0; p < places.size(); ++p)
    {
      places[p].clear();
      volume.for_each_node(vertex(pair, p),
                           [&](unsigned int node, double weight)
                           {
                             const auto place = std::lower_bound(nodes.begin(), nodes.end(), node);
                             places[p].emplace_back(dim * (place - nodes.begin()), weight);
                           });
    }
    const auto size = static_cast<Eigen::Index>(dim * nodes.size());
    block.setZero(size, size);
    for (unsigned int p = 0; p < places.size(); ++p)
      for (unsigned int q = 0; q < places.size(); ++q)
        for (const auto &[row, row_weight] : places[p])
          for (const auto &[column, weight] : places[q])
            block.template block<dim, dim>(row, column) +=
                row_weight * weight * tangent.template block<dim, dim>(dim * p, dim * q);
    add(nodes, block);
  }
}

template <int dim>
void VolumePotential<dim>::for_each_coupling(
    const std::function<void(const std::vector<unsigned int> &nodes)> &add) const
{
  for (unsigned int pair = 0; pair < search.pairs().size(); ++pair)
    add(nodes_of(pair));
}

template <int dim>
void VolumePotential<dim>::add_row_sum_bounds(std::vector<double> &bounds) const
{
  // Σ_ab T_ia T_jb ‖K_ij‖ over all j and b is Σ_a T_ia of the row sums, for weights T that sum to 1.
  for (unsigned int pair = 0; pair < search.pairs().size(); ++pair)
  {
    std::array<double, SimplexPair<dim>::n_vertices> of_vertices{};
    make_pair(pair).add_row_sum_bounds(skin, of_vertices);
    for (unsigned int p = 0; p < SimplexPair<dim>::n_vertices; ++p)
      volume.for_each_node(vertex(pair, p), [&](unsigned int node, double weight)
                           { bounds[node] += weight * of_vertices[p]; });
  }
}

template <int dim>
SpatialVector<dim> VolumePotential<dim>::force_on_first(const State &state)
{
  SpatialVector<dim> force = SpatialVector<dim>::Zero();
  for (unsigned int a = 0; a <= dim; ++a)
    force += state.forces[a];
  return force;
}

template <int dim>
std::vector<double> VolumePotential<dim>::sunk_shares() const
{
  std::vector<double> shares(volume.simplices.size(), 0.);
  for (const auto &[pair, state] : overlaps)
  {
    const auto &[first, second] = search.pairs()[pair];
    shares[first] += state.shares[0];
    shares[second] += state.shares[1];
  }
  return shares;
}

template <int dim>
ContactMeasures<dim> VolumePotential<dim>::measure(const std::vector<double> &all_sunk_shares) const
{
  ContactMeasures<dim> measures;
  measures.resultants.assign(volume.n_bodies, SpatialVector<dim>::Zero());
  measures.n_pairs = static_cast<unsigned int>(search.pairs().size());
  measures.n_active = static_cast<unsigned int>(overlaps.size());
  for (unsigned int pair = 0; pair < search.pairs().size(); ++pair)
    measures.max_stiffness = std::max(measures.max_stiffness, stiffness(pair));
  SpatialVector<dim> area = SpatialVector<dim>::Zero(); // of the first simplex with one other body
  for (std::size_t i = 0; i < overlaps.size(); ++i)
  {
    const auto &[pair, state] = overlaps[i];
    area += state.area;
    if (i + 1 == overlaps.size() || &simplex(overlaps[i + 1].pair, 0) != &simplex(pair, 0) ||
        simplex(overlaps[i + 1].pair, 1).body != simplex(pair, 1).body)
    {
      measures.area += area.norm();
      area.setZero();
    }
    measures.resultants[simplex(pair, 0).body] += force_on_first(state);
    measures.resultants[simplex(pair, 1).body] -= force_on_first(state);
    for (unsigned int side = 0; side < 2; ++side)
    {
      const auto &[first, second] = search.pairs()[pair];
      const double sunk_share = std::min(1., all_sunk_shares[side == 0 ? first : second]);
      const double sunk_depth = simplex(pair, side).height * (1. - std::pow(1. - sunk_share, 1. / dim));
      // Of two equal depths that of a corner counts, which has a place.
      constexpr double slightly_less = 1. - 1e-9;
      const double depth = std::max(state.depths[side], slightly_less * sunk_depth);
      measures.max_penetration = std::max(measures.max_penetration, depth);
      measures.max_pressure = std::max(measures.max_pressure, 2. * state.largest_potentials[side]);
      const double relative_depth = depth / simplex(pair, side).layer_thickness;
      if (relative_depth > measures.max_penetration_over_thickness)
      {
        measures.max_penetration_over_thickness = relative_depth;
        measures.deepest_body = simplex(pair, 1 - side).body;
        measures.deepest_thickness = simplex(pair, side).layer_thickness;
        measures.deepest_position = state.deepest_positions[side];
      }
    }
  }
  return measures;
}

template <int dim>
PairForces<dim> VolumePotential<dim>::pair_forces() const
{
  PairForces<dim> forces;
  for (const auto &[pair, state] : overlaps)
    forces.bodies.try_emplace({simplex(pair, 0).body, simplex(pair, 1).body}, SpatialVector<dim>::Zero())
        .first->second += force_on_first(state);
  return forces;
}

template <int dim>
void VolumePotential<dim>::add_cell_errors(std::vector<double> &errors) const
{
  for (const auto &[pair, state] : overlaps)
    for (unsigned int side = 0; side < 2; ++side)
      errors[simplex(pair, side).cell] += state.energy;
}

template <int dim>
std::set<std::vector<unsigned int>> VolumePotential<dim>::faces_in_contact() const
{
  std::set<std::vector<unsigned int>> faces;
  for (const auto &[pair, state] : overlaps)
    for (unsigned int opposite = 0; opposite < SimplexPair<dim>::n_vertices; ++opposite)
      if (state.is_face_in_contact[opposite])
      {
        std::array<unsigned int, dim> corners;
        const auto &vertices = simplex(pair, opposite / (dim + 1)).vertices;
        for (unsigned int i = 0; i < dim; ++i)
          corners[i] = vertices[i < opposite % (dim + 1) ? i : i + 1];
        faces.insert(collect_nodes(corners));
      }
  return faces;
}

template class VolumePotential<2>;
template class VolumePotential<3>;
} // namespace signorini::contact
