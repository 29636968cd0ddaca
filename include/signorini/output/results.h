// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/adaptivity/error_estimate.h"
#include "signorini/base/traffic.h"
#include "signorini/contact/potential/contact_potential.h"
#include "signorini/output/displacement_error.h"
#include "signorini/parameters/parameters.h"
#include "signorini/physics/ledger.h"

#include <Eigen/Core>

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace signorini
{
/// One body, or an obstacle, at one moment.
struct BodyRecord
{
  Triple position{};      ///< of its centre of mass; of an obstacle its point [m]
  Triple displacement{};  ///< of its centre of mass [m]
  Triple velocity{};      ///< of its centre of mass; zero in quasi-static runs [m/s]
  Triple contact_force{}; ///< on a body, with that of the contact damping [N; N/m in 2-D]
  Triple half_widths{};   ///< of its box along the axes; zero of an obstacle [m]

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &position &displacement &velocity &contact_force &half_widths;
  }
};

/// Contact force on a body from another one or an obstacle, with that of the contact damping.
struct ContactResultant
{
  std::string on, from;
  std::array<double, 3> force{}; ///< [N; N/m in 2-D]
};

/// Force that a support exerts on its body in the component that it prescribes.
struct SupportForce
{
  std::string body, boundary;
  unsigned int component = 0;
  double force = 0.; ///< [N; N/m in 2-D]
};

struct HistoryRow
{
  double time = 0.;
  std::vector<BodyRecord> bodies;                           ///< and after them the obstacles
  double rubbed_off = 0.;                                   ///< by friction until then [J; J/m in 2-D]
  std::set<std::pair<unsigned int, unsigned int>> touching; ///< those with a force between them

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &time &bodies &rubbed_off &touching;
  }
};

/// A part of the program that the scene did not need.
struct LeftOutPart
{
  std::string name, reason;
};

/// One comparison with an exact solution.
struct ErrorRow
{
  std::string quantity;
  double computed = 0.;
  double exact = 0.;
  double relative_error = 0.; ///< signed, (computed − exact)/|exact| unless the quantity says otherwise
};

/// One impact of two bodies, or of a body and an obstacle, as the rows of the history show it.
struct Collision
{
  enum class Outcome
  {
    bounced,                 ///< they have parted, their centres on the same sides as before
    passed_through,          ///< they have parted, their centres have exchanged sides
    touching,                ///< not parted at the end of the history
    touching_from_the_start, ///< they have parted like `bounced`, but no row shows them before
  };

  unsigned int one = 0, other = 0; ///< see HistoryRow::bodies
  double begin = 0., end = 0.;     ///< first and last row with a force between them [s]
  Outcome outcome = Outcome::touching;
};

/// All that a finished run is reported from, the same on every rank.
template <int dim>
struct Results
{
  const Parameters *parameters = nullptr;
  std::string status = "running";
  std::string reason; ///< of a failure or an interruption
  std::vector<std::string> warnings;
  std::vector<std::string> parts_built;
  std::vector<LeftOutPart> parts_left_out;
  unsigned int n_dofs = 0, n_cells = 0, n_steps = 0, n_iterations = 0;
  std::map<std::string, double> run_time; ///< by section [s]
  double total_run_time = 0.;
  double memory_peak_mb = 0.;
  /// What the parts of the run hold at its end, on all ranks [bytes]; none where that is not known.
  struct Memory
  {
    double mesh = 0.;    ///< cells, degrees of freedom, elasticity, and whatever is not named below
    double solver = 0.;  ///< matrices, factors and vectors of the solver and the error estimate
    double contact = 0.; ///< surfaces, neighbours, points and feet
  };
  std::optional<Memory> memory;
  Traffic traffic; ///< of the rank that sent most, from the end of the set-up to that of the run

  bool has_contact = false;
  double penalty_factor = 0.;                 ///< α, at the end
  unsigned int n_facets = 0;                  ///< of all ranks, at the end
  unsigned int n_facets_held = 0;             ///< most that any rank has of them for one term, at the end
  std::optional<double> correction_change;    ///< of the pressures in the last step of correction, relative
  contact::ContactMeasures<dim> contact;      ///< of all contact terms at the end
  double max_penetration = 0.;                ///< of the whole run [m]
  double max_penetration_over_thickness = 0.; ///< of the whole run
  double max_pressure = 0.;                   ///< of the whole run [Pa]
  double max_area = 0.;                       ///< of the whole run [m²; m in 2-D]
  unsigned int max_n_pairs = 0;
  double max_stiffness = 0.;                ///< k_A, of the whole run [Pa/m]
  std::vector<ContactResultant> resultants; ///< at the end, of pairs that may touch
  std::vector<contact::ContactSample<dim>> samples;
  std::vector<unsigned int> sample_bodies;
  std::vector<double> sample_thicknesses;
  double max_projected_pressure = 0.; ///< at the end, see ContactForce::projected_pressures() [Pa]
  std::vector<double>
      nodal_pressures; ///< smallest and largest at the end, see ContactForce::nodal_pressures() [Pa]

  bool has_ledger = false; ///< explicit runs; `energy` of others holds elastic and contact only
  EnergyLedger energy;
  double max_ledger_residual = 0.;
  MomentumLedger momentum;
  double max_linear_drift = 0., max_angular_drift = 0.;

  std::vector<double> body_masses;
  std::vector<double> body_volumes;
  Eigen::Matrix3d smallest_stress = Eigen::Matrix3d::Zero(); ///< componentwise over all cells [Pa]
  Eigen::Matrix3d largest_stress = Eigen::Matrix3d::Zero();
  std::vector<HistoryRow> history;
  std::vector<Collision> collisions;        ///< of runs in motion, see find_collisions()
  std::vector<SupportForce> support_forces; ///< at the end of quasi-static runs
  double largest_support_displacement = 0.;
  std::array<double, 3> total_load{};                       ///< resultant of the loads at the end [N]
  std::vector<std::array<double, 3>> body_end_displacement; ///< largest displacement by component [m]
  ErrorEstimate estimate;                                   ///< of the last load step or output of fields
  DisplacementError displacement_error;                     ///< where the exact solution has a displacement
  std::vector<ErrorRow> errors;

  /// What has been gathered step by step, for boost's archives; all else is found at the end.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &warnings &n_steps &n_iterations &penalty_factor &history;
    archive &max_penetration &max_penetration_over_thickness &max_pressure &max_area &max_n_pairs
        &max_stiffness;
    archive &has_ledger &energy &max_ledger_residual &momentum &max_linear_drift &max_angular_drift;
  }
};
} // namespace signorini
