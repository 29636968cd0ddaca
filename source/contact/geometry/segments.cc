// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/segments.h"

#include "signorini/contact/geometry/line_rule.h"
#include "signorini/contact/geometry/local_domain.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace signorini::contact
{
namespace
{
constexpr double smallest_share = 1e-14; ///< overlaps below this part of the contactor are dropped

using PlanePoint = Eigen::Vector2d;

/// A polygon in the plane, counter-clockwise. Two convex quadrilaterals share at most eight corners; the room
/// beyond is for corners that round-off doubles.
struct Polygon
{
  std::array<PlanePoint, 16> corner;
  unsigned int n_corners = 0;

  Polygon() { corner.fill(PlanePoint::Zero()); }

  void add(const PlanePoint &p)
  {
    if (n_corners < corner.size())
      corner[n_corners++] = p;
  }

  const PlanePoint &next(const unsigned int i) const { return corner[(i + 1) % n_corners]; }

  double area() const
  {
    double twice = 0.;
    for (unsigned int i = 1; i + 1 < n_corners; ++i)
      twice += cross(corner[i] - corner[0], corner[i + 1] - corner[0]);
    return 0.5 * twice;
  }
};

/// What of `polygon` lies to the left of the line from a to b.
Polygon cut(const Polygon &polygon, const PlanePoint &a, const PlanePoint &b)
{
  Polygon left;
  for (unsigned int i = 0; i < polygon.n_corners; ++i)
  {
    const PlanePoint &p = polygon.corner[i], &q = polygon.next(i);
    const double height_p = cross(b - a, p - a), height_q = cross(b - a, q - a);
    if (height_p >= 0.)
      left.add(p);
    if ((height_p > 0. && height_q < 0.) || (height_p < 0. && height_q > 0.))
      left.add(p + height_p / (height_p - height_q) * (q - p));
  }
  return left;
}

Polygon intersect(Polygon polygon, const Polygon &convex)
{
  for (unsigned int i = 0; i < convex.n_corners && polygon.n_corners > 2; ++i)
    polygon = cut(polygon, convex.corner[i], convex.next(i));
  return polygon;
}

/// A convex part of a facet seen along a normal: a quadrilateral or a triangle, with the facet's local
/// coordinates at its corners.
struct Piece
{
  Polygon outline;
  std::array<PlanePoint, 4> xi;

  Piece() { xi.fill(PlanePoint::Zero()); }

  PlanePoint find_local_point(const PlanePoint &x) const;
};

/// At most four sub-facets of two triangles each.
struct Pieces
{
  std::array<Piece, 8> piece;
  unsigned int n_pieces = 0;
};

/// (u, v) ∈ [0, 1]² with x = p_0 + b u + c v + d u v on a convex quadrilateral with corners p_0 … p_3 around.
PlanePoint invert_bilinear(const Polygon &quadrilateral, const PlanePoint &x)
{
  const auto &p = quadrilateral.corner;
  const PlanePoint b = p[1] - p[0], c = p[3] - p[0], d = (p[2] - p[3]) - b, e = x - p[0];
  // e − c v is along b + d v: a quadratic A v² + B v + C = 0; its roots without cancellation.
  const double A = cross(d, c), B = cross(b, c) + cross(e, d), C = cross(e, b);
  const double q = -0.5 * (B + std::copysign(std::sqrt(std::max(0., B * B - 4. * A * C)), B));
  const auto excess = [](const double v) { return std::max(-v, v - 1.); };
  double v = (q != 0. ? C / q : 0.);
  if (A != 0. && excess(q / A) < excess(v))
    v = q / A;
  v = std::clamp(v, 0., 1.);
  const PlanePoint along = b + d * v;
  double u = std::clamp((e - c * v).dot(along) / std::max(along.squaredNorm(), 1e-300), 0., 1.);

  // One step of Newton's method takes back what the roots lost to round-off.
  const PlanePoint first = b + d * v, second = c + d * u, rest = e - b * u - second * v;
  const double determinant = cross(first, second);
  if (determinant > 1e-8 * first.norm() * second.norm())
  {
    u = std::clamp(u + cross(rest, second) / determinant, 0., 1.);
    v = std::clamp(v + cross(first, rest) / determinant, 0., 1.);
  }
  return {u, v};
}

PlanePoint Piece::find_local_point(const PlanePoint &x) const
{
  if (outline.n_corners == 4)
  {
    const PlanePoint uv = invert_bilinear(outline, x);
    return xi[0] + uv.x() * (xi[1] - xi[0]) + uv.y() * (xi[3] - xi[0]);
  }
  const PlanePoint b = outline.corner[1] - outline.corner[0], c = outline.corner[2] - outline.corner[0];
  const PlanePoint e = x - outline.corner[0];
  const double u = std::clamp(cross(e, c) / cross(b, c), 0., 1.);
  const double v = std::clamp(cross(b, e) / cross(b, c), 0., 1. - u);
  return xi[0] + u * (xi[1] - xi[0]) + v * (xi[2] - xi[0]);
}

void add_piece(const Piece &piece, Pieces &pieces)
{
  if (piece.outline.area() > 0.)
    pieces.piece[pieces.n_pieces++] = piece;
}

/// Adds a piece as it is where it is convex, else cut in two at the corner that bends inwards most.
void add_convex_pieces(const Piece &whole, Pieces &pieces)
{
  if (whole.outline.n_corners == 3)
    return add_piece(whole, pieces);
  const auto &corner = whole.outline.corner;
  std::array<double, 4> bend;
  for (unsigned int i = 0; i < 4; ++i)
    bend[i] = cross(corner[i] - corner[(i + 3) % 4], corner[(i + 1) % 4] - corner[i]);
  const auto lowest = std::min_element(bend.begin(), bend.end());
  if (*lowest >= 0.)
    return add_piece(whole, pieces);
  const auto k = static_cast<unsigned int>(lowest - bend.begin());
  for (unsigned int half = 0; half < 2; ++half)
  {
    Piece triangle;
    for (const unsigned int i : {k, k + 1 + half, k + 2 + half})
    {
      triangle.xi[triangle.outline.n_corners] = whole.xi[i % 4];
      triangle.outline.add(corner[i % 4]);
    }
    add_piece(triangle, pieces);
  }
}

enum class Seen
{
  from_outside,
  from_inside
};

/// The facet's sub-facets, projected on the plane of the two axes.
Pieces make_pieces(const FacetNodes<3> &nodes, const SpatialVector<3> &origin,
                   const Eigen::Matrix<double, 2, 3> &axes, const Seen seen)
{
  Pieces pieces;
  for (const SubFacet &part : get_sub_facets(nodes))
  {
    Piece whole;
    for (unsigned int k = 0; k < part.n_corners; ++k)
    {
      const unsigned int node = part.corner[seen == Seen::from_outside ? k : part.n_corners - 1 - k];
      whole.xi[k] = node_coordinates(nodes, node);
      whole.outline.add(axes * (nodes.position[node] - origin));
    }
    add_convex_pieces(whole, pieces);
  }
  return pieces;
}

/// Area times mean normal of the sub-facets.
SpatialVector<3> compute_mean_normal(const FacetNodes<3> &nodes)
{
  SpatialVector<3> normal = SpatialVector<3>::Zero();
  for (const SubFacet &part : get_sub_facets(nodes))
  {
    const auto side = [&](const unsigned int k) -> SpatialVector<3>
    { return nodes.position[part.corner[k]] - nodes.position[part.corner[0]]; };
    for (unsigned int k = 1; k + 1 < part.n_corners; ++k)
      normal += 0.5 * side(k).cross(side(k + 1));
  }
  return normal;
}

SpatialVector<2> compute_mean_normal(const FacetNodes<2> &nodes)
{
  const SpatialVector<2> chord = nodes.position[nodes.degree] - nodes.position[0];
  return {chord.y(), -chord.x()};
}

using Points3 = std::vector<FacetQuadraturePoint<3>>;

/// Adds the points of one triangle; the product rule's points gather towards `tip`.
void add_triangle_points(const PlanePoint &tip, const PlanePoint &a, const PlanePoint &b,
                         const unsigned int n_points, Points3 &points)
{
  const double twice_area = cross(a - tip, b - tip);
  if (twice_area <= 0.)
    return;
  const LineRule &across = get_line_rule(n_points, LineWeight::constant),
                 &outwards = get_line_rule(n_points, LineWeight::linear);
  for (unsigned int i = 0; i < n_points; ++i)
    for (unsigned int j = 0; j < n_points; ++j)
    {
      const PlanePoint base = a + across.point[j] * (b - a);
      points.push_back(
          {tip + outwards.point[i] * (base - tip), twice_area * outwards.weight[i] * across.weight[j]});
    }
}

/// Adds the points of a polygon in local coordinates: triangles from its centroid, or itself if it is one.
void add_polygon_points(const Polygon &polygon, const unsigned int n_points, Points3 &points)
{
  if (polygon.n_corners == 3)
    return add_triangle_points(polygon.corner[0], polygon.corner[1], polygon.corner[2], n_points, points);
  PlanePoint moment = PlanePoint::Zero();
  double six_areas = 0.;
  for (unsigned int i = 1; i + 1 < polygon.n_corners; ++i)
  {
    const PlanePoint p = polygon.corner[i] - polygon.corner[0], q = polygon.corner[i + 1] - polygon.corner[0];
    moment += cross(p, q) * (p + q);
    six_areas += 3. * cross(p, q);
  }
  if (six_areas <= 0.)
    return;
  const PlanePoint centroid = polygon.corner[0] + moment / six_areas;
  for (unsigned int i = 0; i < polygon.n_corners; ++i)
    add_triangle_points(centroid, polygon.corner[i], polygon.next(i), n_points, points);
}

/// The polygon is cut in space, where outlines are straight, but the rule is placed on its corners' image in
/// local coordinates, where the shape functions are polynomials: so both the weights' sum and the moments are
/// exact.
Points3 make_overlap_points(const FacetNodes<3> &contactor, const FacetNodes<3> &target,
                            const SpatialVector<3> &normal, const unsigned int n_points)
{
  Eigen::Matrix<double, 2, 3> axes;
  axes.row(0) = normal.unitOrthogonal();
  axes.row(1) = normal.normalized().cross(SpatialVector<3>(axes.row(0)));
  const SpatialVector<3> &origin = contactor.position[0];
  const Pieces theirs = make_pieces(target, origin, axes, Seen::from_inside);
  const Pieces ours = make_pieces(contactor, origin, axes, Seen::from_outside);
  Points3 points;
  for (unsigned int c = 0; c < ours.n_pieces; ++c)
    for (unsigned int t = 0; t < theirs.n_pieces; ++t)
    {
      Polygon overlap = intersect(theirs.piece[t].outline, ours.piece[c].outline);
      for (unsigned int i = 0; i < overlap.n_corners; ++i)
        overlap.corner[i] = ours.piece[c].find_local_point(overlap.corner[i]);
      if (overlap.n_corners > 2)
        add_polygon_points(overlap, n_points, points);
    }
  return points;
}

/// In 2-D outlines are intervals along the contactor's chord.
std::vector<FacetQuadraturePoint<2>> make_overlap_points(const FacetNodes<2> &contactor,
                                                         const FacetNodes<2> &target,
                                                         const SpatialVector<2> &normal,
                                                         const unsigned int n_points)
{
  const SpatialVector<2> axis = SpatialVector<2>(-normal.y(), normal.x()).normalized();
  const auto coordinate = [&](const SpatialVector<2> &x) { return axis.dot(x - contactor.position[0]); };
  const LineRule &rule = get_line_rule(n_points, LineWeight::constant);
  std::vector<FacetQuadraturePoint<2>> points;
  for (unsigned int c = 0; c < contactor.degree; ++c)
    for (unsigned int t = 0; t < target.degree; ++t)
    {
      const double begin = coordinate(contactor.position[c]), end = coordinate(contactor.position[c + 1]);
      const double low = std::max(begin, coordinate(target.position[t + 1]));
      const double high = std::min(end, coordinate(target.position[t]));
      if (end <= begin || high <= low)
        continue;
      const double size = 1. / contactor.degree, share = (high - low) / (end - begin);
      for (unsigned int i = 0; i < n_points; ++i)
      {
        const double part = (low - begin) / (end - begin) + rule.point[i] * share;
        points.push_back({LocalPoint<2>(size * (c + part)), size * share * rule.weight[i]});
      }
    }
  return points;
}
} // namespace

template <int dim>
std::vector<FacetQuadraturePoint<dim>> make_gauss_points(const FacetType type, const unsigned int n_points)
{
  const LineRule &rule = get_line_rule(n_points, LineWeight::constant);
  std::vector<FacetQuadraturePoint<dim>> points;
  if constexpr (dim == 2)
    for (unsigned int i = 0; i < n_points; ++i)
      points.push_back({LocalPoint<2>(rule.point[i]), rule.weight[i]});
  else if (type == FacetType::triangle)
    add_triangle_points(local_corner(type, 0), local_corner(type, 1), local_corner(type, 2), n_points,
                        points);
  else
    for (unsigned int j = 0; j < n_points; ++j)
      for (unsigned int i = 0; i < n_points; ++i)
        points.push_back({LocalPoint<3>(rule.point[i], rule.point[j]), rule.weight[i] * rule.weight[j]});
  return points;
}

template <int dim>
std::vector<FacetQuadraturePoint<dim>> make_segment_points(const FacetNodes<dim> &contactor,
                                                           const FacetNodes<dim> &target,
                                                           const unsigned int n_points)
{
  const SpatialVector<dim> normal = compute_mean_normal(contactor);
  if (!(normal.dot(compute_mean_normal(target)) < 0.))
    return {};
  auto points = make_overlap_points(contactor, target, normal, n_points);
  double covered = 0.;
  for (const auto &point : points)
    covered += point.weight;
  if (covered < smallest_share)
    points.clear();
  return points;
}

template std::vector<FacetQuadraturePoint<2>> make_gauss_points<2>(FacetType, unsigned int);
template std::vector<FacetQuadraturePoint<3>> make_gauss_points<3>(FacetType, unsigned int);
template std::vector<FacetQuadraturePoint<2>> make_segment_points(const FacetNodes<2> &,
                                                                  const FacetNodes<2> &, unsigned int);
template std::vector<FacetQuadraturePoint<3>> make_segment_points(const FacetNodes<3> &,
                                                                  const FacetNodes<3> &, unsigned int);
} // namespace signorini::contact
