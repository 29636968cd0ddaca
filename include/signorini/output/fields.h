// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/adaptivity/error_estimate.h"
#include "signorini/discretization/surface_map.h"
#include "signorini/physics/state.h"
#include "signorini/solvers/scene_forces.h"

#include <deal.II/dofs/dof_handler.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace signorini
{
/// Writes solution_NNNN.pvtu with its pieces, solution_NNNN.I.vtu, and keeps solution.pvd, the list of all of
/// them, up to date. Ranks with many cells write several pieces, which bounds the memory that it takes.
///
/// Point data: displacement [m], velocity [m/s] (explicit runs), contact_pressure [Pa] and gap [m] (with
/// contact; of the pressure see ContactForce::nodal_pressures(); the gap is at most one layer thickness and
/// negative where bodies overlap). Where bodies touch by the volume potential, which knows neither, these are
/// obstacle_pressure and obstacle_gap, of contact with obstacles alone. Cell data: body, error_indicator (its
/// share of the estimated error in the energy norm, both parts [J^½]), von_mises_stress and the components of
/// the true stress [Pa], and equivalent_plastic_strain in scenes where bodies may yield.
template <int dim>
class Fields
{
public:
  explicit Fields(std::string directory);

  /// Takes a new mesh; `map` is null in scenes without contact. Both must live until the next call.
  void set_mesh(const Discretization<dim> &discretization, const SurfaceMap<dim> *map);

  /// Throws FileError (collective).
  void write(const State &state, const SceneForces<dim> &forces, const ErrorEstimate &estimate);

  /// The list of what has been written, for boost's archives.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &records;
  }

private:
  /// Scalar fields on one part of the mesh.
  struct ContactFields
  {
    dealii::DoFHandler<dim> dof_handler;
    std::vector<std::pair<unsigned int, dealii::types::global_dof_index>> held; ///< surface node, scalar dof
    dealii::IndexSet relevant;
  };

  /// By node of this rank's surface.
  struct NodalContact
  {
    std::vector<double> pressures; ///< [Pa]
    std::vector<double> gaps;      ///< [m]
  };

  void number_contact_fields();
  std::unique_ptr<ContactFields> number_contact_fields_of(const MeshPart<dim> &part) const;
  NodalContact project_contact(const SceneForces<dim> &forces) const;
  std::pair<Vector, Vector> spread(const NodalContact &nodal, const ContactFields &fields) const;

  const Discretization<dim> *discretization = nullptr;
  const SurfaceMap<dim> *map = nullptr;
  std::string directory;
  std::vector<std::unique_ptr<ContactFields>> contacts; ///< one a part of the mesh; none without contact
  std::vector<std::pair<double, std::string>> records;
};
} // namespace signorini
