// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

namespace signorini
{
/// Where the energy of a run is, and what crossed its border [J; J/m in 2-D]. It closes when
/// kinetic + elastic + contact + dissipated (both), plastic work, rubbed off and lost − (work of loads,
/// supports and obstacles) − (renewals and adaptation) stays at its first value.
struct EnergyLedger
{
  double kinetic = 0.;
  double elastic = 0.;
  double contact = 0.;                 ///< in penetrations and in the elastic slip of friction
  double dissipated = 0.;              ///< by contact damping, since the start
  double dissipated_by_viscosity = 0.; ///< in the bodies, since the start
  double plastic_work = 0.;            ///< done in yielding, since the start
  double rubbed_off = 0.;              ///< by friction, since the start
  double work_of_loads = 0.;           ///< since the start
  double work_of_supports = 0.;        ///< since the start
  double work_of_obstacles = 0.;       ///< that of what moves them, since the start
  double contact_renewals =
      0.; ///< stored energy that came with renewed contact stiffnesses or points, since the start
  double contact_loss = 0.;   ///< taken by implicit steps of contact, since the start
  double adaptation = 0.;     ///< by which the sum of the first three jumped with the mesh, since the start
  double max_adaptation = 0.; ///< largest of these jumps, without its sign
  double initial = 0.;        ///< kinetic + elastic + contact at the start
  double largest = 0.;        ///< largest of the sums of magnitudes seen: the scale of the residual

  /// kinetic + elastic + contact.
  double stored() const { return kinetic + elastic + contact; }
  /// Books what stored() has become with a new mesh; `before`: what it was on the old one.
  void book_adaptation(double before);
  /// What is missing or too much.
  double imbalance() const;
  /// imbalance() over `largest`.
  double residual() const;
  /// Takes the present sums into account for `largest`.
  void note_scale();

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &kinetic &elastic &contact &dissipated &dissipated_by_viscosity &plastic_work &rubbed_off
        &work_of_loads &work_of_supports &work_of_obstacles &contact_renewals &contact_loss &adaptation
            &max_adaptation &initial &largest;
  }
};

/// Linear and angular momentum (about the origin) and what changed them from outside. In 2-D only the first
/// two and the last component are used.
struct MomentumLedger
{
  std::array<double, 3> linear{};          ///< [kg m/s]
  std::array<double, 3> angular{};         ///< [kg m²/s]
  std::array<double, 3> linear_impulse{};  ///< of loads, supports and obstacles, since the start [N s]
  std::array<double, 3> angular_impulse{}; ///< their moment about the origin [N m s]
  std::array<double, 3> initial_linear{};
  std::array<double, 3> initial_angular{};
  double linear_scale = 0.;  ///< largest Σ m|v| seen
  double angular_scale = 0.; ///< largest Σ m|x||v| seen

  /// |momentum − initial − impulse| over the scale.
  double linear_drift() const;
  double angular_drift() const;

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &linear &angular &linear_impulse &angular_impulse &initial_linear &initial_angular &linear_scale
        &angular_scale;
  }
};
} // namespace signorini
