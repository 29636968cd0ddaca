// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/potential/pair_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace signorini::contact
{
namespace
{
/// 1/(1/m_c + 1/m_t) of the two surface layers of mass ρh/2 each; an obstacle does not move.
template <int dim>
double compute_layer_mass(const Facet<dim> &contactor, const Facet<dim> *target)
{
  const double mass = .5 * contactor.density * contactor.layer_thickness;
  if (target == nullptr || mass == 0.)
    return mass;
  const double target_mass = .5 * target->density * target->layer_thickness;
  return mass * target_mass / (mass + target_mass);
}
} // namespace

template <int dim>
PairList<dim>::PairList(const ContactSurface<dim> &contact_surface, Obstacles rigid_obstacles,
                        PotentialSettings potential_settings)
    : surface(contact_surface), given_obstacles(std::move(rigid_obstacles)), obstacles_(given_obstacles),
      shifts_of_obstacles(obstacles_.size(), SpatialVector<dim>::Zero()),
      shifts_at_search(shifts_of_obstacles), settings_(std::move(potential_settings)), skin_(compute_skin()),
      reach_(compute_reach()), neighbour_list(surface, reach_, skin_, allowed_pairs())
{
  for (const Facet<dim> &facet : surface.facets)
    largest_motion_factor_ = std::max(largest_motion_factor_, lebesgue_constant(facet));
  for (const FacetElement<dim> &element : surface.elsewhere.elements)
    largest_motion_factor_ = std::max(largest_motion_factor_, lebesgue_constant(element));
  for (const Facet<dim> &facet : surface.facets)
    if (FacetPoints &points = gauss_points[index(facet)]; points.empty())
      for (const auto &point : make_gauss_points<dim>(facet.type, settings_.n_quadrature_points))
        points.push_back({point, evaluate_facet_shape(facet, point.xi).value});
}

template <int dim>
void PairList<dim>::check_input() const
{
  if (!(settings_.penalty_factor > 0.))
    throw std::invalid_argument(
        fmt::format("The penalty factor must be positive, but is {}.", settings_.penalty_factor));
  if (settings_.n_quadrature_points == 0)
    throw std::invalid_argument("The contact potential needs at least one quadrature point a direction.");
  if (!(settings_.skin_over_thickness > 0.))
    throw std::invalid_argument(fmt::format("The skin must be positive, but is {} layer thicknesses.",
                                            settings_.skin_over_thickness));
  if (settings_.damping_ratio && !(*settings_.damping_ratio >= 0.))
    throw std::invalid_argument(
        fmt::format("The damping ratio must not be negative, but is {}.", *settings_.damping_ratio));
  for (std::size_t f = 0; f < surface.facets.size(); ++f)
    if (!(surface.facets[f].layer_thickness > 0.) || !(surface.facets[f].youngs_modulus > 0.))
      throw std::invalid_argument(
          fmt::format("Facet {} needs a positive layer thickness and Young's modulus, but has {} and {}.", f,
                      surface.facets[f].layer_thickness, surface.facets[f].youngs_modulus));
}

template <int dim>
double PairList<dim>::compute_skin() const
{
  check_input();
  const double thickness = surface.smallest_layer_thickness();
  const bool is_any = thickness < std::numeric_limits<double>::max();
  return is_any ? settings_.skin_over_thickness * thickness : 1.;
}

/// At least one skin, so that all within a skin of the surface is seen.
template <int dim>
std::vector<double> PairList<dim>::compute_reach() const
{
  std::vector<double> all_reach;
  all_reach.reserve(surface.facets.size());
  for (const Facet<dim> &facet : surface.facets)
    all_reach.push_back(std::max(facet.layer_thickness, skin_));
  return all_reach;
}

template <int dim>
auto PairList<dim>::allowed_pairs() const -> IsAllowedPair
{
  if (!settings_.meets_bodies)
    return nullptr;
  std::set<std::pair<unsigned int, unsigned int>> excluded;
  for (const auto &[one, other] : settings_.excluded_body_pairs)
    excluded.insert({std::minmax(one, other)});
  const std::set<unsigned int> self(settings_.self_contact.begin(), settings_.self_contact.end());
  return [excluded, self](unsigned int body, unsigned int other)
  { return body == other ? self.count(body) > 0 : excluded.count(std::minmax(body, other)) == 0; };
}

template <int dim>
bool PairList<dim>::may_bodies_touch() const
{
  const std::size_t n = surface.n_bodies;
  return settings_.meets_bodies &&
         (!settings_.self_contact.empty() || 2 * settings_.excluded_body_pairs.size() < n * (n - 1));
}

template <int dim>
bool PairList<dim>::is_stale(const Positions &positions) const
{
  for (std::size_t i = 0; i < obstacles_.size(); ++i)
    if (!((shifts_of_obstacles[i] - shifts_at_search[i]).norm() <= .5 * skin_))
      return true;
  return neighbour_list.is_stale(positions);
}

template <int dim>
void PairList<dim>::move_obstacles(const Positions &shifts)
{
  for (std::size_t i = 0; i < obstacles_.size(); ++i)
    if (shifts[i] != shifts_of_obstacles[i])
      obstacles_[i] = given_obstacles[i]->moved(shifts[i]);
  shifts_of_obstacles = shifts;
}

template <int dim>
void PairList<dim>::search(const Positions &positions)
{
  neighbour_list.rebuild(positions);
  shifts_at_search = shifts_of_obstacles;
}

template <int dim>
auto PairList<dim>::renew(const Positions &positions) -> Feet
{
  ++n_renewals_;

  const Pairs old_pairs = std::move(body_pairs_);
  body_pairs_.clear();
  Feet feet;
  for (unsigned int i = 0; i < neighbour_list.neighbours().size(); ++i)
    add_body_pairs(i, positions, feet);
  if (settings_.integration == Integration::face_quadrature)
    keep_coefficients(old_pairs);

  obstacle_pairs_.clear();
  for (unsigned int i = 0; i < obstacles_.size(); ++i)
    add_obstacle_pairs(i, positions);
  largest_stiffness_ = 0.;
  for (const Pairs *pairs : {&body_pairs_, &obstacle_pairs_})
    for (const ContactPair<dim> &pair : *pairs)
      largest_stiffness_ = std::max(largest_stiffness_, pair.stiffness);
  return feet;
}

template <int dim>
void PairList<dim>::keep_coefficients(const Pairs &old_pairs)
{
  std::map<PairKey<dim>, const ContactPair<dim> *> old_pair_of;
  for (const ContactPair<dim> &pair : old_pairs)
    old_pair_of.emplace(key_of(pair), &pair);
  for (ContactPair<dim> &pair : body_pairs_)
  {
    const auto old_pair = old_pair_of.find(key_of(pair));
    if (old_pair != old_pair_of.end())
    {
      pair.stiffness = old_pair->second->stiffness;
      pair.damping = old_pair->second->damping;
      set_offset(pair);
    }
  }
}

template <int dim>
double PairList<dim>::largest_offset() const
{
  double largest = 0.;
  if (!multipliers.empty())
    for (const ContactPair<dim> &pair : body_pairs_)
      largest = std::max(largest, pair.offset);
  return largest;
}

template <int dim>
void PairList<dim>::add_body_pairs(unsigned int neighbours, const Positions &positions, Feet &feet)
{
  const FacetNeighbours &found = neighbour_list.neighbours()[neighbours];
  Making making{neighbours, positions, {surface.facets, positions, found.candidates}, feet};
  if (settings_.integration == Integration::face_segments)
    for (const unsigned int candidate : found.candidates)
      add_segment_pairs(candidate, making);
  else
    for (const FacetPoint &point : gauss_points[index(surface.facets[found.facet])])
      add_body_pair(point, std::nullopt, making);
}

template <int dim>
void PairList<dim>::add_segment_pairs(unsigned int candidate, Making &making)
{
  const Facet<dim> &contactor = surface.facets[neighbour_list.neighbours()[making.neighbours].facet];
  for (const auto &point : make_segment_points(gather_nodes(contactor, making.positions),
                                               gather_nodes(surface.facets[candidate], making.positions),
                                               settings_.n_quadrature_points))
    add_body_pair({point, evaluate_facet_shape(contactor, point.xi).value}, candidate, making);
}

template <int dim>
void PairList<dim>::add_body_pair(const FacetPoint &point, std::optional<unsigned int> facing, Making &making)
{
  ContactPair<dim> pair;
  pair.neighbours = making.neighbours;
  pair.facet = neighbour_list.neighbours()[pair.neighbours].facet;
  pair.target = neighbour_list.neighbours()[pair.neighbours].target_body;
  pair.xi = point.point.xi;

  const double motion = largest_motion_factor_ * skin_;
  const SpatialVector<dim> x = interpolate(surface.facets[pair.facet], point.shape, making.positions);
  const SurfacePlace<dim> contactor{pair.facet, pair.xi};
  const SurfaceFoot<dim> foot = making.search.find(x, reach_[pair.facet] + motion, &contactor);
  if (foot.depth < -2. * motion) // too far outside (or −∞) to touch before the next renewal
    return;
  if (facing && foot.facet != *facing)
  {
    // A facet that faces the contactor from the far side of its own body must not make a second point here.
    // It is told by its distance; near a rim, where the foot may be on the side, the facet above is still
    // meant.
    const double distance =
        find_closest_point(gather_nodes(surface.facets[*facing], making.positions), x).distance;
    const double far = std::max(2. * foot.closest.distance, .5 * reach_[pair.facet]);
    if (distance > std::min(far, reach_[pair.facet]))
      return;
  }
  set_coefficients(pair, point, &surface.facets[foot.facet]);
  body_pairs_.push_back(pair);
  making.feet.push_back(foot);
}

template <int dim>
void PairList<dim>::add_obstacle_pairs(unsigned int obstacle, const Positions &positions)
{
  const double largest_gap = 2. * largest_motion_factor_ * skin_;
  std::vector<typename Obstacle<dim>::Foot> node_feet;
  obstacles_[obstacle]->find_feet(positions, node_feet);

  std::vector<ContactPair<dim>> near;
  Positions points;
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
  {
    const Facet<dim> &facet = surface.facets[f];
    // Depth changes by no more than the distance walked.
    if (!facet.owned || is_excluded_obstacle(facet.body, obstacle) ||
        node_feet[facet.nodes[0]].depth + make_facet_box(facet, positions).diagonal().norm() < -largest_gap)
      continue;
    for (const FacetPoint &point : gauss_points[index(facet)])
    {
      ContactPair<dim> pair;
      pair.facet = f;
      pair.target = obstacle;
      set_coefficients(pair, point, nullptr);
      near.push_back(pair);
      points.push_back(interpolate(facet, point.shape, positions));
    }
  }

  obstacles_[obstacle]->find_feet(points, node_feet);
  for (std::size_t i = 0; i < near.size(); ++i)
    if (node_feet[i].depth >= -largest_gap)
      obstacle_pairs_.push_back(near[i]);
}

template <int dim>
bool PairList<dim>::is_excluded_obstacle(unsigned int body, unsigned int obstacle) const
{
  const auto &excluded = settings_.excluded_obstacle_pairs;
  return std::find(excluded.begin(), excluded.end(), std::pair(body, obstacle)) != excluded.end();
}

template <int dim>
void PairList<dim>::set_coefficients(ContactPair<dim> &pair, const FacetPoint &point,
                                     const Facet<dim> *target) const
{
  const Facet<dim> &contactor = surface.facets[pair.facet];
  pair.xi = point.point.xi;
  pair.shape = point.shape;
  const FacetFrame<dim> undeformed =
      evaluate_facet_frame(gather_nodes(contactor, surface.reference_positions), pair.xi);
  pair.area = point.point.weight * undeformed.area_normal.norm() * (target == nullptr ? 1. : .5);

  double compliance = contactor.layer_thickness / contactor.youngs_modulus;
  if (target != nullptr)
    compliance += target->layer_thickness / target->youngs_modulus;
  pair.stiffness = settings_.penalty_factor / compliance;
  if (settings_.damping_ratio)
    pair.damping =
        2. * *settings_.damping_ratio * std::sqrt(pair.stiffness * compute_layer_mass(contactor, target));
  set_offset(pair);
}

template <int dim>
void PairList<dim>::set_offset(ContactPair<dim> &pair) const
{
  pair.offset = 0.;
  if (multipliers.empty())
    return;
  for (unsigned int a = 0; a < surface.facets[pair.facet].n_nodes(); ++a)
    pair.offset += pair.shape[a] * multipliers[pair.facet][a];
  // Between the nodes of a quadratic facet the interpolation may undershoot.
  pair.offset = std::max(pair.offset, 0.) / pair.stiffness;
}

template <int dim>
void PairList<dim>::set_multipliers(NodalPressures<dim> new_multipliers)
{
  multipliers = std::move(new_multipliers);
  for (Pairs *pairs : {&body_pairs_, &obstacle_pairs_})
    for (ContactPair<dim> &pair : *pairs)
      set_offset(pair);
}

template <int dim>
void PairList<dim>::set_penalty_factor(double penalty_factor)
{
  const double ratio = penalty_factor / settings_.penalty_factor;
  settings_.penalty_factor = penalty_factor;
  check_input();
  largest_stiffness_ *= ratio;
  for (Pairs *pairs : {&body_pairs_, &obstacle_pairs_})
    for (ContactPair<dim> &pair : *pairs)
    {
      pair.stiffness *= ratio;
      pair.damping *= std::sqrt(ratio);
      set_offset(pair);
    }
}

template class PairList<2>;
template class PairList<3>;
} // namespace signorini::contact
