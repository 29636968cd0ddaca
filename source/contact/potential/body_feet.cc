// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/potential/body_feet.h"

#include "signorini/contact/potential/foot_slide.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace signorini::contact
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double round_off = 1e-9, share_of_skin = .125; ///< over the skin: of distances; looked ahead

/// The shape functions of a facet of degree 1 in 3-D.
std::array<double, 9> evaluate_linear_shape(const FacetType type, const LocalPoint<3> &xi)
{
  const double a = 1. - xi[0], b = 1. - xi[1];
  if (type == FacetType::triangle)
    return {a - xi[1], xi[0], xi[1]};
  return {a * b, xi[0] * b, a * xi[1], xi[0] * xi[1]};
}

/// t_0 × t_1 of a facet of degree 1, not scaled.
SpatialVector<3> linear_normal(const Facet<3> &facet, const LocalPoint<3> &xi,
                               const std::vector<SpatialVector<3>> &positions)
{
  const auto &node = facet.nodes;
  const SpatialVector<3> &origin = positions[node[0]];
  SpatialVector<3> first = positions[node[1]] - origin, second = positions[node[2]] - origin;
  if (facet.type == FacetType::tensor_product)
  {
    const SpatialVector<3> twist = positions[node[3]] - positions[node[1]] - second;
    first += xi[1] * twist;
    second += xi[0] * twist;
  }
  return first.cross(second);
}

/// How far a facet is from a point, at least: seen along the way to the middle of its corners. Tells more
/// than a box whose sides are askew to the facet, or less. Zero or less where it tells nothing.
template <int dim>
double bound_distance_along_way(const Facet<dim> &facet, const SpatialVector<dim> &x,
                                const std::vector<SpatialVector<dim>> &positions)
{
  if (facet.degree > 1)
    return 0.;
  SpatialVector<dim> direction = -double(facet.n_nodes()) * x;
  for (unsigned int a = 0; a < facet.n_nodes(); ++a)
    direction += positions[facet.nodes[a]];
  double least = infinity;
  for (unsigned int a = 0; a < facet.n_nodes(); ++a)
    least = std::min(least, (positions[facet.nodes[a]] - x).dot(direction));
  return least / direction.norm();
}
} // namespace

template <int dim>
void BodyFeet<dim>::forget(const PairList<dim> &pair_list)
{
  feet.resize(pair_list.body_pairs().size());
  sleeps_until.assign(feet.size(), -infinity);
  alone_until.assign(feet.size(), -infinity);
  for (Near &near : all_near)
    near.covers = -infinity;
  found_within = -1.;
}

template <int dim>
void BodyFeet<dim>::restart(const PairList<dim> &pair_list, const std::vector<SurfaceFoot<dim>> &found)
{
  forget(pair_list);
  pairs = &pair_list;
  for (unsigned int i = 0; i < feet.size(); ++i)
  {
    feet[i].facet = found[i].facet;
    feet[i].xi = found[i].closest.xi;
    feet[i].depth = found[i].depth;
    note_found(i);
  }
}

template <int dim>
void BodyFeet<dim>::note_motion(double distance)
{
  way += 2. * (1. + 1e-12) * distance;
  found_within = -1.;
}

template <int dim>
void BodyFeet<dim>::note_found(unsigned int pair)
{
  // Facets that are no candidates may be as near as the reach.
  const double reach = pairs->reach(pairs->body_pairs()[pair].facet);
  double &depth = feet[pair].depth;
  sleeps_until[pair] = way + std::clamp(-depth, 0., reach);
  if (depth <= -pairs->skin() || depth > reach)
    depth = -infinity;
}

template <int dim>
void BodyFeet<dim>::find_awake(double gap)
{
  const double slack = gap + pairs->largest_offset() + round_off * pairs->skin();
  awake.clear();
  for (unsigned int i = 0; i < sleeps_until.size(); ++i)
    if (!(sleeps_until[i] - way > slack))
      awake.push_back(i);
}

template <int dim>
void BodyFeet<dim>::find_within(double gap, const Positions &positions,
                                const ContactSurface<dim> &contact_surface, const PairList<dim> &pair_list)
{
  if (gap <= found_within)
    return;
  surface = &contact_surface;
  pairs = &pair_list;
  found_within = gap;
  ++date;
  boxes.resize(surface->facets.size());
  all_near.resize(pairs->neighbours().size());
  find_awake(gap);
  touching_.clear();
  for (std::size_t begin = 0; begin < awake.size(); begin += chunk.n)
  {
    chunk.n = static_cast<unsigned int>(std::min<std::size_t>(chunk_size, awake.size() - begin));
    std::copy_n(awake.begin() + static_cast<std::ptrdiff_t>(begin), chunk.n, chunk.pair.begin());
    find_chunk(positions);
  }
}

template <int dim>
void BodyFeet<dim>::find_chunk(const Positions &positions)
{
  const auto &list = pairs->body_pairs();
  Selection is_known{};
  for (unsigned int k = 0; k < chunk.n; ++k)
    is_known[k] = sleeps_until[chunk.pair[k]] > -infinity;
  chunk.is_found = find_inner_feet_of_chunk(is_known, positions);
  for (unsigned int k = 0; k < chunk.n; ++k)
    chunk.is_found[k] &= faces_target(chunk.pair[k], positions);
  for (unsigned int begin = 0, end = 0; begin < chunk.n; begin = end)
  {
    const unsigned int neighbours = list[chunk.pair[begin]].neighbours;
    while (end < chunk.n && list[chunk.pair[end]].neighbours == neighbours)
      ++end;
    reject_where_others_are_near(begin, end, positions);
  }
  Selection is_searched{};
  for (unsigned int k = 0; k < chunk.n; ++k)
    if (!chunk.is_found[k])
    {
      find_by_search(chunk.pair[k], positions);
      is_searched[k] = std::isfinite(feet[chunk.pair[k]].depth);
    }
  // By the same arithmetic as all others, so that no digit depends on what was known before.
  find_inner_feet_of_chunk(is_searched, positions);
  for (unsigned int k = 0; k < chunk.n; ++k)
  {
    const unsigned int pair = chunk.pair[k];
    note_found(pair);
    if (feet[pair].depth + list[pair].offset > 0.)
      touching_.push_back(pair);
  }
}

template <int dim>
auto BodyFeet<dim>::find_inner_feet_of_chunk(const Selection &is_asked, const Positions &positions)
    -> Selection
{
  Selection is_found{};
  if constexpr (dim == 3)
  {
    constexpr unsigned int size = InnerFeetBatch::size;
    InnerFeetBatch batch{};
    for (unsigned int k = 0; k < chunk.n;)
    {
      std::array<unsigned int, size> place;
      unsigned int n = 0;
      for (; k < chunk.n && n < size; ++k)
        if (is_asked[k] && surface->facets[feet[chunk.pair[k]].facet].degree == 1)
        {
          put_into_batch(chunk.pair[k], n, positions, batch);
          place[n++] = k;
        }
      if (n == 0)
        break;
      find_inner_feet(batch);
      for (unsigned int i = 0; i < n; ++i)
        if ((is_found[place[i]] = batch.is_inner[i] != 0.))
          take_from_batch(i, batch, feet[chunk.pair[place[i]]]);
    }
  }
  return is_found;
}

template <int dim>
void BodyFeet<dim>::put_into_batch(unsigned int pair, unsigned int i, const Positions &positions,
                                   InnerFeetBatch &batch)
{
  if constexpr (dim == 3)
  {
    const ContactPair<dim> &of_foot = pairs->body_pairs()[pair];
    PairFoot<dim> &foot = feet[pair];
    foot.position = interpolate(surface->facets[of_foot.facet], of_foot.shape, positions);
    const Facet<dim> &target = surface->facets[foot.facet];
    const bool is_triangle = target.type == FacetType::triangle;
    for (unsigned int d = 0; d < dim; ++d)
    {
      for (unsigned int a = 0; a < 3; ++a)
        batch.node[a][d][i] = positions[target.nodes[a]][d];
      batch.node[3][d][i] = is_triangle ? batch.node[1][d][i] + batch.node[2][d][i] - batch.node[0][d][i]
                                        : positions[target.nodes[3]][d];
      batch.point[d][i] = foot.position[d];
    }
    batch.rim[i] = is_triangle ? 0. : 2.;
  }
}

template <int dim>
void BodyFeet<dim>::take_from_batch(unsigned int i, const InnerFeetBatch &batch, PairFoot<dim> &foot)
{
  if constexpr (dim == 3)
  {
    foot.depth = batch.depth[i];
    for (unsigned int d = 0; d < dim; ++d)
      foot.normal[d] = batch.normal[d][i];
    for (unsigned int a = 0; a < 2; ++a)
      foot.xi[a] = .5 * (1. + batch.s[a][i]);
    const auto shape = evaluate_linear_shape(surface->facets[foot.facet].type, foot.xi);
    std::copy_n(shape.begin(), 4, foot.shape.begin());
  }
}

/// Below the surface, and not clearly against it, a point may belong to the other flank of a spike.
template <int dim>
bool BodyFeet<dim>::faces_target(unsigned int pair, const Positions &positions) const
{
  const PairFoot<dim> &foot = feet[pair];
  if (!(foot.depth > 0.))
    return true;
  if constexpr (dim == 3)
  {
    const ContactPair<dim> &of_foot = pairs->body_pairs()[pair];
    const Facet<dim> &contactor = surface->facets[of_foot.facet];
    return contactor.degree == 1 && linear_normal(contactor, of_foot.xi, positions).dot(foot.normal) < 0.;
  }
  return false;
}

template <int dim>
auto BodyFeet<dim>::box_of(unsigned int facet, const Positions &positions) -> const DatedBox &
{
  DatedBox &box = boxes[facet];
  if (box.date == date)
    return box;
  const Facet<dim> &of_box = surface->facets[facet];
  box.low = box.high = positions[of_box.nodes[0]];
  for (unsigned int a = 1; a < of_box.n_nodes(); ++a)
  {
    box.low = box.low.cwiseMin(positions[of_box.nodes[a]]);
    box.high = box.high.cwiseMax(positions[of_box.nodes[a]]);
  }
  if (of_box.degree > 1)
  {
    const SpatialVector<dim> bulge = .5 * (lebesgue_constant(of_box) - 1.) * (box.high - box.low);
    box.low -= bulge;
    box.high += bulge;
  }
  box.date = date;
  return box;
}

template <int dim>
const std::vector<unsigned int> &BodyFeet<dim>::find_near(unsigned int neighbours, double distance,
                                                          const Positions &positions)
{
  // FootSearch looks a little farther for the other flank of a spike, by a part of the facet's size.
  constexpr double share_of_size = 1e-3;
  const FacetNeighbours &found = pairs->neighbours()[neighbours];
  if (!(distance < pairs->skin()))
    return found.candidates;
  Near &near = all_near[neighbours];
  if (way + distance <= near.covers)
    return near.candidates;
  const double radius = distance + share_of_skin * pairs->skin();
  const DatedBox of_facet = box_of(found.facet, positions);
  near.candidates.clear();
  for (const unsigned int candidate : found.candidates)
  {
    const DatedBox &box = box_of(candidate, positions);
    if ((box.low - of_facet.high).cwiseMax(of_facet.low - box.high).cwiseMax(0.).norm() <=
        radius + share_of_size * (box.high - box.low).norm())
      near.candidates.push_back(candidate);
  }
  near.covers = way + radius;
  return near.candidates;
}

template <int dim>
double BodyFeet<dim>::bound_distance(unsigned int facet, const SpatialVector<dim> &x,
                                     const Positions &positions)
{
  const DatedBox &box = box_of(facet, positions);
  return std::max((box.low - x).cwiseMax(x - box.high).cwiseMax(0.).norm(),
                  bound_distance_along_way(surface->facets[facet], x, positions));
}

template <int dim>
void BodyFeet<dim>::reject_where_others_are_near(unsigned int begin, unsigned int end,
                                                 const Positions &positions)
{
  const double slack = round_off * pairs->skin(), most = share_of_skin * pairs->skin();
  double farthest = -1.;
  Selection is_asked{};
  for (unsigned int k = begin; k < end; ++k)
    if ((is_asked[k] = chunk.is_found[k] && !(alone_until[chunk.pair[k]] > way)))
    {
      farthest = std::max(farthest, std::abs(feet[chunk.pair[k]].depth) + slack + most);
      alone_until[chunk.pair[k]] = way + .5 * most;
    }
  if (farthest < 0.)
    return;
  const unsigned int neighbours = pairs->body_pairs()[chunk.pair[begin]].neighbours;
  for (const unsigned int candidate : find_near(neighbours, farthest, positions))
    for (unsigned int k = begin; k < end; ++k)
    {
      const PairFoot<dim> &foot = feet[chunk.pair[k]];
      if (!is_asked[k] || foot.facet == candidate)
        continue;
      const double distance = std::abs(foot.depth) + slack;
      double clearance = bound_distance(candidate, foot.position, positions) - distance;
      if (!(clearance > 0.))
        clearance =
            find_closest_point(gather_nodes(surface->facets[candidate], positions), foot.position).distance -
            distance;
      is_asked[k] = chunk.is_found[k] = clearance > 0.;
      alone_until[chunk.pair[k]] = std::min(alone_until[chunk.pair[k]], way + .5 * clearance);
    }
}

template <int dim>
void BodyFeet<dim>::find_by_search(unsigned int i, const Positions &positions)
{
  const ContactPair<dim> &pair = pairs->body_pairs()[i];
  PairFoot<dim> &foot = feet[i];
  alone_until[i] = -infinity;
  double cutoff = infinity;
  if (sleeps_until[i] > -infinity)
  {
    // No farther than the place where the foot was last.
    const SpatialVector<dim> x = interpolate(surface->facets[pair.facet], pair.shape, positions);
    const FacetShape<dim> shape = evaluate_facet_shape(surface->facets[foot.facet], foot.xi);
    cutoff = (1. + 1e-6) * (x - interpolate(surface->facets[foot.facet], shape.value, positions)).norm() +
             round_off * pairs->skin();
  }
  foot = find_pair_foot(*surface, find_near(pair.neighbours, cutoff, positions), pair, positions, cutoff);
}

template <int dim>
PairFoot<dim> find_pair_foot(const ContactSurface<dim> &surface, const std::vector<unsigned int> &candidates,
                             const ContactPair<dim> &pair, const std::vector<SpatialVector<dim>> &at,
                             double cutoff)
{
  PairFoot<dim> result;
  result.position = interpolate(surface.facets[pair.facet], pair.shape, at);
  const SurfacePlace<dim> contactor{pair.facet, pair.xi};
  const SurfaceFoot<dim> foot =
      FootSearch<dim>(surface.facets, at, candidates).find(result.position, cutoff, &contactor);
  if (!std::isfinite(foot.depth))
    return result;
  result.depth = foot.depth;

  const Facet<dim> &target = surface.facets[foot.facet];
  result.facet = foot.facet;
  result.xi = foot.closest.xi;
  result.shape = evaluate_facet_shape(target, foot.closest.xi).value;
  const SpatialVector<dim> gap = result.position - foot.closest.position;
  if (!has_normal_of_facet(target, foot.closest.xi, foot.closest.distance))
  {
    result.normal = gap / -foot.depth;
    return result;
  }
  // Inside a facet, or too close for the gap to have a direction, the facet's normal is the direction: it has
  // none of the round-off that the gap takes from coordinates many orders larger than itself.
  result.normal = evaluate_facet_frame(gather_nodes(target, at), foot.closest.xi).area_normal.normalized();
  result.depth = -gap.dot(result.normal);
  return result;
}

template class BodyFeet<2>;
template class BodyFeet<3>;
template PairFoot<2> find_pair_foot(const ContactSurface<2> &, const std::vector<unsigned int> &,
                                    const ContactPair<2> &, const std::vector<SpatialVector<2>> &, double);
template PairFoot<3> find_pair_foot(const ContactSurface<3> &, const std::vector<unsigned int> &,
                                    const ContactPair<3> &, const std::vector<SpatialVector<3>> &, double);
} // namespace signorini::contact
