// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/coupling/contact_force.h"
#include "signorini/contact/coupling/friction_force.h"
#include "signorini/contact/coupling/volume_contact_force.h"
#include "signorini/physics/internal_force.h"
#include "signorini/physics/viscous_force.h"

#include <memory>
#include <vector>

namespace signorini
{
/// The force terms of a scene, in lists that are empty where the scene has none of the kind.
template <int dim>
struct SceneForces
{
  std::shared_ptr<InternalForce<dim>> elasticity;
  std::vector<std::shared_ptr<ViscousForce<dim>>> viscosities; ///< one of all bodies, or none
  std::vector<std::shared_ptr<ForceTerm>> loads;
  std::vector<std::shared_ptr<ContactTerm<dim>>> contacts;               ///< all, those by volumes first
  std::vector<std::shared_ptr<VolumeContactForce<dim>>> volume_contacts; ///< those of `contacts` by volumes
  std::vector<std::shared_ptr<ContactForce<dim>>> surface_contacts;      ///< those by surfaces
  std::vector<std::shared_ptr<ContactForce<dim>>> damped_contacts;       ///< of these, those with damping
  std::vector<std::shared_ptr<FrictionForce<dim>>> frictions;            ///< on surface contacts
  std::vector<std::shared_ptr<ContactForce<dim>>> moving_contacts; ///< of these, those whose obstacles move
};
} // namespace signorini
