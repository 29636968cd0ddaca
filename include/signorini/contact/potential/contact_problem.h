// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/potential/contact_pair.h"

#include <Eigen/SparseCore>

#include <optional>
#include <utility>
#include <vector>

namespace signorini::contact
{
/// The contact of one implicit time step: the increments δ of the nodes, over where they would be without
/// contact forces, that minimise the convex function
///
///   J(δ) = ½ δᵀ M δ / Δt² + Σ_q A_q ½ ⟨s_q⟩² / a_q,   s_q = a_q d_q − (c_q/Δt) ⟨d_q,start⟩,
///   d_q = d_q* − n_q·Σ_a B_qa δ_a,   a_q = k_q + c_q/Δt,
///
/// with ⟨·⟩ the positive part: springs k and dashpots c that only press, a dashpot acting on the part of the
/// way on which its point touches (doc/theory.md, section 7). The condition for a minimum,
/// M δ / Δt² = Σ_q A_q ⟨s_q⟩ B_qᵀ n_q, is solved by Newton's method with a line search, which ends at the
/// exact minimum once the set of pressing points stands.
template <int dim>
class ContactProblem
{
public:
  using Increments = std::vector<SpatialVector<dim>>;
  /// A node and its share.
  using Weights = std::vector<std::pair<unsigned int, double>>;

  /// `masses` [node] of every component [kg; kg/m in 2-D], infinite where it cannot give way; must outlive
  /// this object. `time_step` [s].
  ContactProblem(const std::vector<SpatialVector<dim>> &masses, double time_step);

  /// Adds a point with the depth it has at δ = 0; `weights` are its B, of nodes that have masses.
  void add(const LinearPoint<dim> &point, const Weights &weights);

  /// All points as plain numbers, and the points of another problem taken from such: for other ranks.
  std::vector<double> pack() const;
  void add_packed(const std::vector<double> &packed);

  /// δ of all nodes [m]; zero where no point acts. Nothing if no minimum was found.
  std::optional<Increments> solve();

  unsigned int n_iterations() const { return n_iterations_; } ///< of the last solve()
  std::size_t n_points() const { return points.size(); }

private:
  struct Point
  {
    std::size_t first_weight = 0, end_weight = 0;
    SpatialVector<dim> normal;
    double area = 0., depth = 0., slope = 0., offset = 0.; ///< A, d*, a, (c/Δt)⟨d_start⟩
  };
  using Vector = Eigen::VectorXd;

  void number_unknowns();
  bool have_same_nodes(const Point &one, const Point &other) const;
  /// Σ_a B_a n·v_a.
  double project(const Point &point, const Vector &values) const;
  void add_along(const Point &point, double factor, Vector &values) const;
  /// s_q of all points.
  std::vector<double> compute_pressures(const Vector &increment) const;
  Vector compute_gradient(const Vector &increment, const std::vector<double> &pressures) const;
  double compute_objective(const Vector &increment, const std::vector<double> &pressures) const;
  Eigen::SparseMatrix<double> assemble(const std::vector<double> &pressures) const;
  void add_block(std::size_t first_point, std::size_t end_point, const std::vector<double> &pressures,
                 std::vector<Eigen::Triplet<double>> &entries) const;
  /// Length of the step along `direction` at which J is least, at most 1.
  double find_length(const Vector &increment, const Vector &direction,
                     const std::vector<double> &pressures) const;

  const std::vector<SpatialVector<dim>> &masses;
  double time_step;
  std::vector<Point> points;
  Weights all_weights;                ///< of all points, one after the other
  std::vector<unsigned int> nodes;    ///< that have unknowns
  std::vector<unsigned int> position; ///< [node] in `nodes`
  Vector inertia;                     ///< m/Δt² by unknown, 0 where it is fixed
  unsigned int n_iterations_ = 0;
};
} // namespace signorini::contact
