// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/potential/simplex_pair.h"

#include <algorithm>
#include <numeric>

namespace signorini::contact
{
namespace
{
template <int dim>
using Coordinates = typename ConvexPolytope<dim>::Coordinates;
template <int dim>
using Tangent = typename SimplexPair<dim>::Tangent;

/// u ⊗ v − v ⊗ u
template <int dim>
SpatialTensor<dim> wedge(const SpatialVector<dim> &u, const SpatialVector<dim> &v)
{
  return u * v.transpose() - v * u.transpose();
}

template <int dim>
auto block(Tangent<dim> &tangent, unsigned int p, unsigned int q)
{
  return tangent.template block<dim, dim>(dim * p, dim * q);
}

/// W_A, or with A and B exchanged W_B: the potential of one simplex, its owner, that acts on the surface of
/// the other one.
template <int dim>
class Side
{
public:
  static constexpr unsigned int n = dim + 1;

  double energy = 0.;
  std::array<SpatialVector<dim>, 2 * n> surface_integrals; ///< S_q

  Side(const SimplexPair<dim> &pair, unsigned int owner_index)
      : owner(*pair.shapes[owner_index]), other(*pair.shapes[1 - owner_index]),
        first_of_owner(n * owner_index), first_of_other(n - first_of_owner),
        strength(pair.strengths[owner_index])
  {
    surface_integrals.fill(SpatialVector<dim>::Zero());
  }

  /// Calls `visit(m, R_m)` for the parts of the overlap with one smallest coordinate λ_m.
  template <typename Visit>
  void for_each_sector(const ConvexPolytope<dim> &overlap, const Visit &visit) const
  {
    for (unsigned int m = 0; m < n; ++m)
    {
      const ConvexPolytope<dim> sector = restrict_to_sector(overlap, first_of_owner / n, m);
      if (!sector.is_empty())
        visit(m, sector);
    }
  }

  void add_energy(unsigned int m, const ConvexPolytope<dim> &sector)
  {
    energy += strength * owner.volume * integrate_coordinates(sector, first_of_owner / n)[first_of_owner + m];
  }

  /// Adds the share of a sector to S_q.
  void add_surfaces(unsigned int m, const ConvexPolytope<dim> &sector)
  {
    for_each_surface(sector, [&](const auto &face, const SpatialVector<dim> &area)
                     { add_surface(area, integrate_products_with(sector, face, first_of_owner + m)); });
  }

  /// The same with the terms of the tangent that are integrals over the surface.
  void add_surfaces(unsigned int m, const ConvexPolytope<dim> &sector, Tangent<dim> &tangent)
  {
    for_each_surface(sector,
                     [&](const auto &face, const SpatialVector<dim> &area)
                     {
                       const FaceMoments<dim> moments = integrate_products(sector, face);
                       add_surface(area, moments.col(first_of_owner + m));
                       const SpatialTensor<dim> stiffness = strength * owner.gradients[m] * area.transpose();
                       for (unsigned int q = 0; q < 2 * n; ++q)
                         for (unsigned int p = 0; p < 2 * n; ++p)
                           block<dim>(tangent, p, q) += sign(p) * sign(q) * moments(p, q) * stiffness;
                     });
  }

  void add_forces(typename SimplexPair<dim>::Forces &forces) const
  {
    for (unsigned int q = 0; q < 2 * n; ++q)
      forces[q] -= surface_integrals[q];
    for (unsigned int a = 0; a < n; ++a)
      forces[first_of_owner + a] -= energy * owner.gradients[a];
  }

  /// Adds the other terms of the tangent, from the turning and stretching of the surfaces.
  void add_turning(Tangent<dim> &tangent) const
  {
    for (unsigned int a = 0; a < n; ++a)
    {
      for (unsigned int q = 0; q < 2 * n; ++q)
      {
        block<dim>(tangent, first_of_other + a, q) += wedge<dim>(other.gradients[a], surface_integrals[q]);
        block<dim>(tangent, q, first_of_owner + a) += wedge<dim>(surface_integrals[q], owner.gradients[a]);
      }
      for (unsigned int b = 0; b < n; ++b)
        block<dim>(tangent, first_of_owner + a, first_of_owner + b) +=
            energy * wedge<dim>(owner.gradients[a], owner.gradients[b]);
    }
  }

  /// See SimplexPair::add_row_sum_bounds(). No later overlap reaches beyond that of the other simplex with
  /// the owner moved outwards by `motion`. There |s_q| is at most λ_q^B, or λ_q^A grown by the motion, and
  /// the sum of all |s_q| is 2.
  void add_row_sum_bounds(double motion, std::array<double, 2 * n> &bounds) const
  {
    const ConvexPolytope<dim> overlap = make_overlap(owner, other, motion);
    if (overlap.is_empty())
      return;
    std::array<double, n> steepness;
    for (unsigned int a = 0; a < n; ++a)
      steepness[a] = owner.gradients[a].norm();
    const double steepest = *std::max_element(steepness.begin(), steepness.end());
    const double sum = std::accumulate(steepness.begin(), steepness.end(), 0.);
    const double highest = strength * bound_lowest_coordinate(overlap, motion, steepness); // of φ
    const double volume = other.volume * integrate_coordinates(overlap, 1).template tail<n>().sum();
    const Coordinates<dim> moments = integrate_over_surface(overlap);
    const double area = moments.template tail<n>().sum();
    const double of_any = 2. * strength * steepest + highest * sum;
    for (unsigned int a = 0; a < n; ++a)
    {
      bounds[first_of_owner + a] += of_any * (moments[a] + motion * steepness[a] * area) +
                                    highest * volume * steepness[a] * (sum - steepness[a]);
      bounds[first_of_other + a] += of_any * moments[n + a] + 2. * highest * area * other.gradients[a].norm();
    }
  }

private:
  /// The largest value that min_m λ_m of the owner may take after the motion.
  static double bound_lowest_coordinate(const ConvexPolytope<dim> &overlap, double motion,
                                        const std::array<double, n> &steepness)
  {
    double bound = 0.;
    for (const Coordinates<dim> &corner : overlap.vertices())
    {
      double lowest = 1. / n;
      for (unsigned int a = 0; a < n; ++a)
        lowest = std::min(lowest, corner[a] + motion * steepness[a]);
      bound = std::max(bound, lowest);
    }
    return bound;
  }

  /// ∫ λ dS over the other simplex' surface in an overlap that counts the owner first.
  Coordinates<dim> integrate_over_surface(const ConvexPolytope<dim> &overlap) const
  {
    // The coordinates of one simplex sum to 1.
    Coordinates<dim> moments = Coordinates<dim>::Zero();
    for (const auto &face : overlap.faces())
      if (face.label / n == 1)
        moments += other.area_vector(face.label % n).norm() *
                   integrate_products(overlap, face).template rightCols<n>().rowwise().sum();
    return moments;
  }

  /// Calls `visit(face, area vector of the whole face)` for the faces of a part in those of the other
  /// simplex.
  template <typename Visit>
  void for_each_surface(const ConvexPolytope<dim> &part, const Visit &visit) const
  {
    for (const auto &face : part.faces())
      if (face.label / n == first_of_other / n)
        visit(face, SpatialVector<dim>(other.area_vector(face.label % n)));
  }

  /// `moments`: ∫ λ_m λ dS over a piece of a face, divided by the area of the face.
  void add_surface(const SpatialVector<dim> &area, const Coordinates<dim> &moments)
  {
    for (unsigned int q = 0; q < 2 * n; ++q)
      surface_integrals[q] += sign(q) * strength * moments[q] * area;
  }

  double sign(unsigned int vertex) const { return vertex / n == first_of_other / n ? 1. : -1.; }

  const SimplexShape<dim> &owner, &other;
  unsigned int first_of_owner, first_of_other; ///< vertices
  double strength;
};

template <int dim>
SpatialVector<dim> locate(const SimplexShape<dim> &shape, const Coordinates<dim> &coordinates)
{
  SpatialVector<dim> x = SpatialVector<dim>::Zero();
  for (unsigned int a = 0; a <= dim; ++a)
    x += coordinates[a] * shape.vertices[a];
  return x;
}

/// The present heights above all faces, in the order of the coordinates.
template <int dim>
Coordinates<dim> measure_heights(const SimplexPair<dim> &pair)
{
  Coordinates<dim> heights;
  for (unsigned int p = 0; p < pair.n_vertices; ++p)
    heights[p] = 1. / pair.shapes[p / (dim + 1)]->gradients[p % (dim + 1)].norm();
  return heights;
}

template <int dim>
void note_depths(const SimplexPair<dim> &pair, const ConvexPolytope<dim> &part,
                 const Coordinates<dim> &heights, typename SimplexPair<dim>::State &state)
{
  for (const Coordinates<dim> &corner : part.vertices())
  {
    const Coordinates<dim> below_faces = corner.cwiseProduct(heights);
    for (unsigned int i = 0; i < 2; ++i)
    {
      const double depth = below_faces.template segment<dim + 1>(i * (dim + 1)).minCoeff();
      const double lowest = corner.template segment<dim + 1>(i * (dim + 1)).minCoeff();
      if (depth > state.depths[i])
        state.deepest_positions[i] = locate<dim>(*pair.shapes[0], corner);
      state.depths[i] = std::max(state.depths[i], depth);
      state.largest_potentials[i] = std::max(state.largest_potentials[i], pair.strengths[i] * lowest);
    }
  }
}

/// Whether a face of the overlap lies within that simplex which is not its own, rather than in a face of it.
template <int dim>
bool is_within(const ConvexPolytope<dim> &overlap, const typename ConvexPolytope<dim>::Face &face)
{
  constexpr double least = 1e-9; // of the height
  Coordinates<dim> sum = Coordinates<dim>::Zero();
  for (const unsigned int vertex : face.vertices)
    sum += overlap.vertices()[vertex];
  const unsigned int other = 1 - face.label / (dim + 1);
  return sum.template segment<dim + 1>(other * (dim + 1)).minCoeff() >
         least * static_cast<double>(face.vertices.size());
}
} // namespace

template <int dim>
auto SimplexPair<dim>::evaluate() const -> std::optional<State>
{
  const ConvexPolytope<dim> overlap = make_overlap(*shapes[0], *shapes[1]);
  if (overlap.is_empty())
    return {};
  State state;
  const Coordinates<dim> heights = measure_heights(*this);
  for (const auto &face : overlap.faces())
  {
    state.is_face_in_contact[face.label] = is_within(overlap, face);
    if (face.label / (dim + 1) == 1)
      state.area += integrate_products(overlap, face).template bottomRightCorner<dim + 1, dim + 1>().sum() *
                    shapes[1]->area_vector(face.label % (dim + 1));
  }

  for (unsigned int owner = 0; owner < 2; ++owner)
  {
    // The coordinates of one simplex sum to 1.
    state.shares[owner] =
        integrate_coordinates(overlap, owner).template segment<dim + 1>(owner * (dim + 1)).sum();
    Side<dim> side(*this, owner);
    side.for_each_sector(overlap,
                         [&](unsigned int m, const ConvexPolytope<dim> &sector)
                         {
                           side.add_energy(m, sector);
                           side.add_surfaces(m, sector);
                           note_depths<dim>(*this, sector, heights, state);
                         });
    side.add_forces(state.forces);
    state.energy += side.energy;
  }
  return state;
}

template <int dim>
bool SimplexPair<dim>::compute_tangent(double verge, Tangent &tangent) const
{
  ConvexPolytope<dim> overlap = make_overlap(*shapes[0], *shapes[1]);
  if (overlap.is_empty())
    overlap = make_overlap(*shapes[0], *shapes[1], verge);
  if (overlap.is_empty())
    return false;
  tangent.setZero();
  for (unsigned int owner = 0; owner < 2; ++owner)
  {
    Side<dim> side(*this, owner);
    side.for_each_sector(overlap,
                         [&](unsigned int m, const ConvexPolytope<dim> &sector)
                         {
                           side.add_energy(m, sector);
                           side.add_surfaces(m, sector, tangent);
                         });
    side.add_turning(tangent);
  }
  return true;
}

template <int dim>
void SimplexPair<dim>::add_row_sum_bounds(double motion, std::array<double, n_vertices> &bounds) const
{
  for (unsigned int owner = 0; owner < 2; ++owner)
    Side<dim>(*this, owner).add_row_sum_bounds(motion, bounds);
}

template struct SimplexPair<2>;
template struct SimplexPair<3>;
} // namespace signorini::contact
