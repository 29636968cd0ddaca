// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/depth.h"

#include "signorini/contact/geometry/local_domain.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace signorini::contact
{
namespace
{
constexpr double pi = 3.14159265358979323846;
constexpr double tie_tolerance = 1e-9;       ///< of places, relative to the facet's size
constexpr double distance_tolerance = 1e-12; ///< of distances, likewise
constexpr double flank_tolerance = 1e-4;     ///< of the distances from the two flanks of a spike, likewise

template <int dim>
SpatialVector<dim> make_unit(const SpatialVector<dim> &v)
{
  const double norm = v.norm();
  return norm > 0. ? SpatialVector<dim>(v / norm) : SpatialVector<dim>(SpatialVector<dim>::Zero());
}

} // namespace

/// The sectors of all facets that meet at a foot.
template <int dim>
struct Fan
{
  SpatialVector<dim> normal = SpatialVector<dim>::Zero(); ///< sum of unit normals times angles

  /// Sum over the sectors of (last − first) unit edge direction, counter-clockwise. In a closed fan the last
  /// edge of each sector is the first of the next, and this is zero. In 2-D: number of ends minus number of
  /// beginnings.
  SpatialVector<dim> open_rim = SpatialVector<dim>::Zero();

  void add_sector(const FacetNodes<dim> &nodes, const LocalPoint<dim> &xi);
  bool is_closed() const { return open_rim.squaredNorm() < 1e-6; }
};

template <>
void Fan<2>::add_sector(const FacetNodes<2> &nodes, const LocalPoint<2> &xi)
{
  const LocalPlace<2> place = find_local_place(nodes, xi, tie_tolerance);
  const bool is_inside = place.n_free == 1;
  normal += (is_inside ? 2. * pi : pi) * make_unit<2>(evaluate_facet_frame(nodes, xi).area_normal);
  if (!is_inside)
    open_rim[0] -= place.directions(0, 0);
}

template <>
void Fan<3>::add_sector(const FacetNodes<3> &nodes, const LocalPoint<3> &xi)
{
  const FacetFrame<3> frame = evaluate_facet_frame(nodes, xi);
  const LocalPlace<3> place = find_local_place(nodes, xi, tie_tolerance);
  double angle = 2. * pi;
  if (place.n_free < 2)
  {
    const auto edge = [&](const int i)
    {
      return make_unit<3>(place.directions(0, i) * frame.tangent[0] +
                          place.directions(1, i) * frame.tangent[1]);
    };
    const SpatialVector<3> first = edge(0), last = (place.n_free == 1 ? SpatialVector<3>(-first) : edge(1));
    angle = (place.n_free == 1 ? pi : std::atan2(first.cross(last).norm(), first.dot(last)));
    open_rim += last - first;
  }
  normal += angle * make_unit<3>(frame.area_normal);
}

/// Which of two facets a contactor faces; its normal is only found once it is asked for.
template <int dim>
class Facing
{
public:
  Facing(const std::vector<Facet<dim>> &all_facets, const std::vector<SpatialVector<dim>> &all_positions,
         const SurfacePlace<dim> *place_of_contactor)
      : facets(all_facets), positions(all_positions), contactor(place_of_contactor)
  {
  }

  bool is_asked() const { return contactor != nullptr; }

  bool is_better(const FacetNodes<dim> &one, const LocalPoint<dim> &xi, const SurfaceFoot<dim> &other)
  {
    return is_asked() && cosine_to(one, xi) < cosine_to(other) - tie_tolerance;
  }

  /// Of the angle between the normals of the contactor and a facet: -1 if they face each other.
  double cosine_to(const FacetNodes<dim> &nodes, const LocalPoint<dim> &xi)
  {
    if (normal == SpatialVector<dim>::Zero())
      normal = normal_of(gather_nodes(facets[contactor->facet], positions), contactor->xi);
    return normal.dot(normal_of(nodes, xi));
  }

  double cosine_to(const SurfaceFoot<dim> &foot)
  {
    return cosine_to(gather_nodes(facets[foot.facet], positions), foot.closest.xi);
  }

private:
  static SpatialVector<dim> normal_of(const FacetNodes<dim> &nodes, const LocalPoint<dim> &xi)
  {
    return make_unit<dim>(evaluate_facet_frame(nodes, xi).area_normal);
  }

  const std::vector<Facet<dim>> &facets;
  const std::vector<SpatialVector<dim>> &positions;
  const SurfacePlace<dim> *contactor; ///< null: none
  SpatialVector<dim> normal = SpatialVector<dim>::Zero();
};

template <int dim>
FootSearch<dim>::FootSearch(const std::vector<Facet<dim>> &all_facets,
                            const std::vector<SpatialVector<dim>> &all_positions,
                            const std::vector<unsigned int> &all_candidates)
    : facets(all_facets), positions(all_positions), candidates(all_candidates)
{
  boxes.reserve(candidates.size());
  for (unsigned int c = 0; c < candidates.size(); ++c)
    boxes.push_back(make_box(nodes_of(c)));
}

/// A box that surely holds the facet. A facet of degree 2 may bulge out of the box of its nodes, by no more
/// than the Lebesgue constant allows.
template <int dim>
auto FootSearch<dim>::make_box(const FacetNodes<dim> &nodes) -> Box
{
  SpatialVector<dim> lower = nodes.position[0], upper = nodes.position[0];
  const unsigned int n_nodes = nodes.n_nodes();
  for (unsigned int i = 1; i < n_nodes; ++i)
  {
    lower = lower.cwiseMin(nodes.position[i]);
    upper = upper.cwiseMax(nodes.position[i]);
  }
  return {0.5 * (lower + upper), 0.5 * lebesgue_constant(nodes) * (upper - lower)};
}

template <int dim>
auto FootSearch<dim>::find_nearest_box(const SpatialVector<dim> &x, const double cutoff) const
    -> std::optional<Nearest>
{
  double least = std::numeric_limits<double>::infinity();
  unsigned int nearest = 0;
  for (unsigned int c = 0; c < boxes.size(); ++c)
    if (const double squared_distance = boxes[c].squared_distance(x); squared_distance < least)
    {
      least = squared_distance;
      nearest = c;
    }
  if (boxes.empty() || !(least <= cutoff * cutoff))
    return {};
  return Nearest{nearest, find_closest_point(nodes_of(nearest), x)};
}

template <int dim>
SurfaceFoot<dim> FootSearch<dim>::find_closest_facet(const SpatialVector<dim> &x, const double cutoff,
                                                     Facing<dim> facing) const
{
  SurfaceFoot<dim> best;
  best.closest.xi.setZero();
  best.closest.position = x;
  best.closest.distance = std::numeric_limits<double>::infinity();
  best.depth = -std::numeric_limits<double>::infinity();
  const std::optional<Nearest> nearest = find_nearest_box(x, cutoff);
  if (!nearest)
    return best;
  // What is farther does not matter; the round-off is much more than what makes facets equally close.
  constexpr double round_off = 1e-9;
  const double bound = std::min(cutoff, (1. + round_off) * nearest->closest.distance +
                                            round_off * boxes[nearest->candidate].half_width.norm());
  for (unsigned int c = 0; c < candidates.size(); ++c)
  {
    const Box &box = boxes[c];
    const double tie = facing.is_asked() ? distance_tolerance * box.half_width.norm() : 0.,
                 limit = std::min(bound, best.closest.distance + tie);
    if (box.squared_distance(x) > limit * limit)
      continue;
    const FacetNodes<dim> nodes = nodes_of(c);
    const ClosestPoint<dim> closest =
        c == nearest->candidate ? nearest->closest : find_closest_point(nodes, x);
    if (closest.distance > limit)
      continue;
    if (closest.distance < best.closest.distance * (1. - 1e-12) - tie ||
        facing.is_better(nodes, closest.xi, best))
    {
      best.facet = candidates[c];
      best.closest = closest;
      best.depth = -closest.distance;
    }
  }
  return best;
}

template <int dim>
SurfaceFoot<dim> FootSearch<dim>::turn_to_front(const SurfaceFoot<dim> &foot, const SpatialVector<dim> &x,
                                                Facing<dim> facing) const
{
  constexpr double half = .5; // flanks are at most 60 degrees off
  if (facing.cosine_to(foot) < half)
    return foot;
  SurfaceFoot<dim> front = foot;
  front.closest.distance = std::numeric_limits<double>::infinity();
  for (unsigned int c = 0; c < candidates.size(); ++c)
  {
    const double limit = foot.closest.distance + flank_tolerance * boxes[c].half_width.norm();
    if (boxes[c].squared_distance(x) > limit * limit)
      continue;
    const FacetNodes<dim> nodes = nodes_of(c);
    const ClosestPoint<dim> closest = find_closest_point(nodes, x);
    if (closest.distance <= std::min(limit, front.closest.distance) &&
        facing.cosine_to(nodes, closest.xi) < -half)
      front = {candidates[c], closest, closest.distance};
  }
  return std::isinf(front.closest.distance) ? foot : front;
}

template <int dim>
Fan<dim> FootSearch<dim>::gather_fan(const SpatialVector<dim> &foot) const
{
  Fan<dim> fan;
  for (unsigned int c = 0; c < candidates.size(); ++c)
  {
    const double tolerance = 2. * tie_tolerance * boxes[c].half_width.norm();
    if (boxes[c].squared_distance(foot) > tolerance * tolerance)
      continue;
    // Asked from the foot, not from x: a facet that holds the foot may be as close to x at another place too.
    const FacetNodes<dim> nodes = nodes_of(c);
    const ClosestPoint<dim> closest = find_closest_point(nodes, foot);
    if (closest.distance <= tolerance)
      fan.add_sector(nodes, closest.xi);
  }
  return fan;
}

template <int dim>
SurfaceFoot<dim> FootSearch<dim>::find(const SpatialVector<dim> &x, const double cutoff,
                                       const SurfacePlace<dim> *contactor) const
{
  const Facing<dim> facing(facets, positions, contactor);
  SurfaceFoot<dim> foot = find_closest_facet(x, cutoff, facing);
  if (std::isinf(foot.closest.distance))
    return foot;

  const SpatialVector<dim> outwards = foot.closest.position - x;
  const Facet<dim> &facet = facets[foot.facet];
  Fan<dim> fan;
  if (find_local_place(facet, foot.closest.xi, tie_tolerance).n_free == dim - 1)
    fan.normal = evaluate_facet_frame(gather_nodes(facet, positions), foot.closest.xi).area_normal;
  else
    fan = gather_fan(foot.closest.position);

  // Beside the rim of an open surface there is no inside; below it there is.
  const double least = fan.is_closed() ? 0. : std::sqrt(0.5) * foot.closest.distance * fan.normal.norm();
  const bool is_inside = outwards.dot(fan.normal) > least;
  foot.depth = is_inside ? foot.closest.distance : -foot.closest.distance;
  return is_inside && facing.is_asked() ? turn_to_front(foot, x, facing) : foot;
}

template class FootSearch<2>;
template class FootSearch<3>;
} // namespace signorini::contact
