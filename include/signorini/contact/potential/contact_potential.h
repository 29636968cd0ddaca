// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/geometry/depth.h"
#include "signorini/contact/search/neighbour_list.h"
#include "signorini/scene/obstacle.h"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace signorini::contact
{
/// Where the contact potential is sampled.
enum class Integration
{
  face_quadrature, ///< fixed Gauss points of every face: cheap, a fixed potential
  face_segments    ///< Gauss points on the parts where a face meets the other body's faces: passes the patch test
};

struct PotentialSettings
{
  double penalty_factor = 10.; ///< α > 0
  Integration integration = Integration::face_quadrature;
  unsigned int n_quadrature_points = 3; ///< a direction, on a face or a segment
  double skin_over_thickness = 0.5;     ///< skin of the neighbour list over the smallest layer thickness
  std::vector<std::pair<unsigned int, unsigned int>> excluded_body_pairs;
  std::vector<std::pair<unsigned int, unsigned int>> excluded_obstacle_pairs; ///< (body, obstacle)
  std::optional<double> damping_ratio;                                        ///< ξ ≥ 0
};

/// What the contact of this rank's owned facets amounts to at the last evaluation.
template <int dim>
struct ContactMeasures
{
  double max_penetration = 0.;                ///< [m]
  double max_penetration_over_thickness = 0.; ///< over the layer thickness h of the point's own facet
  double max_pressure = 0.;                   ///< k_A d [Pa]
  double max_stiffness = 0.;                  ///< k_A over all pairs [Pa/m]
  double area = 0.;                           ///< undeformed area under positive pressure [m²; m in 2-D]
  unsigned int n_pairs = 0;                   ///< point–target pairs in the list
  unsigned int n_active = 0;                  ///< of these, those with positive depth
  unsigned int deepest_facet = 0;             ///< where max_penetration_over_thickness is reached
  SpatialVector<dim> deepest_position = SpatialVector<dim>::Zero();
  std::vector<SpatialVector<dim>> resultants; ///< contact force on every body [N; N/m in 2-D]
};

/// One sampled point with contact or near it, for reports.
template <int dim>
struct ContactSample
{
  unsigned int facet = 0;
  LocalPoint<dim> xi;
  SpatialVector<dim> position;
  double depth = 0.;    ///< negative: a gap [m]
  double pressure = 0.; ///< k_A d where positive [Pa]
  double area = 0.;     ///< undeformed area the point stands for [m²]
};

/// The surface contact potential of a scene,
///
///   W(x) = Σ_q A_q ½ k_A,q d_q²   over points q with depth d_q > 0,      k_A = α / (h_c/E_c + h_t/E_t),
///
/// and its exact derivatives. Points q lie on the faces of every deformable body (its undeformed area measures A_q);
/// where the other side is deformable too, both sides are sampled and each counts half, so that neither is
/// preferred. With y(ξ) the closest point of the other surface, ½ d² = min_ξ ½ |x − y(ξ)|², hence the
/// gradient needs no derivative of ξ, and the Hessian is a Schur complement over the free directions of ξ.
///
/// Forces act on the surface's nodes; each pair's forces sum to zero, and so do their moments.
/// E_t = ∞ and h_t = 0 for obstacles. k_A of a pair is fixed when the pair is made (by the closest facet then);
/// what the stored energy changes by when pairs are made anew is returned by update().
///
/// Use: update(x) whenever positions changed, evaluate(x), then any of the const functions.
/// All sums run over owned facets only; add over ranks for totals.
template <int dim>
class ContactPotential
{
public:
  using Positions = std::vector<SpatialVector<dim>>;
  using Obstacles = std::vector<std::shared_ptr<const Obstacle<dim>>>;

  /// `surface` must outlive this object.
  ContactPotential(const ContactSurface<dim> &surface, Obstacles obstacles, PotentialSettings settings);

  /// Renews neighbours and points where that is needed: never more often than every half skin of motion with
  /// face quadrature, at every call with face segments. Returns the jump of the stored energy [J] that the renewal
  /// caused, 0 if there was none.
  double update(const Positions &positions);

  /// Whether some node moved so far since the last renewal that neighbours may be missing.
  bool is_stale(const Positions &positions) const;

  /// Finds the feet of all points. Everything below speaks of these positions.
  void evaluate(const Positions &positions);

  double energy() const; ///< [J]

  /// Adds −∂W/∂x.
  void add_forces(std::vector<SpatialVector<dim>> &forces) const;

  /// Adds the forces of the damping σ_c = 2ξ√(k_A m_A)·ḋ, with k_A d + σ_c clipped at 0, apart from the
  /// conservative ones. Does nothing without a damping ratio. Returns the dissipated power [W], ≥ 0.
  double add_damping_forces(const std::vector<SpatialVector<dim>> &velocities,
                            std::vector<SpatialVector<dim>> &forces) const;

  /// Calls `add(nodes, block)` for every active pair with its Hessian block of size dim·n_nodes, node-major.
  void for_each_tangent(const std::function<void(const std::vector<unsigned int> &nodes,
                                                 const Eigen::MatrixXd &block)> &add) const;

  /// Adds to every node a bound of the row sums |∂²W/∂x∂x| [N/m] and of the damping matrix [N s/m] that would hold if
  /// all pairs near enough to touch were active: what a critical time step is computed from.
  void add_row_sum_bounds(std::vector<double> &stiffness, std::vector<double> &damping) const;

  ContactMeasures<dim> measure() const;
  std::vector<ContactSample<dim>> samples() const;
};
} // namespace signorini::contact
