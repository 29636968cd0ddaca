// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/potential/contact_pair.h"

#include <Eigen/SparseCore>

#include <functional>
#include <optional>
#include <vector>

namespace signorini::contact
{
/// The contact of one implicit time step: the increments δ of the nodes, over where they would be without
/// contact forces, that the forces at δ give their masses,
///
///   M δ / Δt² = Σ_q A_q (⟨p_q⟩ n_q − k_q s_q) on the nodes,
///   p_q = a_q d_q − (c_q/Δt) ⟨d_q,start⟩,   d_q = d_q* − n_q·Σ_a B_qa δ_a,   a_q = k_q + c_q/Δt,
///
/// with ⟨·⟩ the positive part: springs k and dashpots c that only press, a dashpot acting on the part of the
/// way on which its point touches, and with the elastic slips s_q that Coulomb's law leaves of linear ones
/// (LinearSlip) under the pressures ⟨p_q⟩ (doc/theory.md, section 7).
///
/// Without friction δ minimises the convex function J(δ) = ½ δᵀ M δ / Δt² + Σ_q A_q ½ ⟨p_q⟩² / a_q, and
/// Newton's method with a line search ends at its exact minimum once the set of pressing points stands. With
/// friction every step of it goes towards the minimum that there is if cones stay as wide as the last
/// pressures make them; it ends when they do.
template <int dim>
class ContactProblem
{
public:
  using Increments = std::vector<SpatialVector<dim>>;

  /// What a point has of a node: its B and its L.
  struct Weight
  {
    unsigned int node;
    double share;
    SpatialVector<dim> lever;

    Weight(unsigned int the_node, double the_share,
           const SpatialVector<dim> &the_lever = SpatialVector<dim>::Zero())
        : node(the_node), share(the_share), lever(the_lever)
    {
    }
  };
  using Weights = std::vector<Weight>;

  /// `masses` [node] of every component [kg; kg/m in 2-D], infinite where it cannot give way; must outlive
  /// this object. `time_step` [s].
  ContactProblem(const std::vector<SpatialVector<dim>> &masses, double time_step);

  /// Adds a point with the depth and the slip it has at δ = 0; `weights` are of nodes that have masses.
  void add(const LinearPoint<dim> &point, const Weights &weights);

  /// All points as plain numbers, for other ranks.
  std::vector<double> pack() const;

  /// Adds points packed by another problem, whose nodes `number` gives the number they have in this one.
  void add_packed(const std::vector<double> &packed,
                  const std::function<unsigned int(unsigned int node)> &number);

  /// δ of all nodes [m]; zero where no point acts. Nothing if none was found.
  std::optional<Increments> solve();

  unsigned int n_iterations() const { return n_iterations_; } ///< of the last solve()
  std::size_t n_points() const { return points.size(); }

private:
  struct Point
  {
    std::size_t first_weight = 0, end_weight = 0;
    SpatialVector<dim> normal, trial;
    double area = 0., depth = 0., slope = 0., offset = 0.; ///< A, d*, a, (c/Δt)⟨d_start⟩
    double stiffness = 0., coefficient = 0.;               ///< k, μ
  };

  /// What a point has at some δ, whatever it makes of it.
  struct Strain
  {
    double pressure;         ///< p, which may be negative
    SpatialVector<dim> slip; ///< as if all of it were elastic

    bool is_pressing() const { return pressure > 0.; }
  };
  using Strains = std::vector<Strain>;
  using Vector = Eigen::VectorXd;
  using Factors = Eigen::Matrix<double, Eigen::Dynamic, dim>;

  void number_unknowns();
  bool have_same_nodes(const Point &one, const Point &other) const;
  /// Σ_a (B_a + L_a nᵀ) v_a.
  SpatialVector<dim> project(const Point &point, const Vector &values) const;
  /// The transpose: adds what a force on the point is on its nodes.
  void add_force(const Point &point, const SpatialVector<dim> &force, Vector &values) const;
  Strains compute_strains(const Vector &increment) const;
  /// What `strain` would be of elastic slip, in a cone as wide as `pressure` makes it.
  static SpatialVector<dim> find_elastic_slip(const Point &point, const SpatialVector<dim> &slip,
                                              double pressure);
  /// −∂(force/A)/∂(what project() gives), in the same cone.
  static SpatialTensor<dim> compute_stiffness(const Point &point, const Strain &strain);
  Vector compute_gradient(const Vector &increment, const Strains &strains) const;
  /// Of the springs and dashpots.
  double compute_energy(const Strains &strains) const;
  Eigen::SparseMatrix<double> assemble(const Strains &strains) const;
  void add_block(std::size_t first_point, std::size_t end_point, const Strains &strains,
                 std::vector<Eigen::Triplet<double>> &entries) const;
  /// Length of the step along `direction` at which J is least in cones that stay, at most 1.
  double find_length(const Vector &increment, const Vector &direction, const Strains &strains) const;
  /// Whether forces are at `after` what they are as linear functions from `before` on.
  bool have_settled(const Strains &before, const Strains &after) const;

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
