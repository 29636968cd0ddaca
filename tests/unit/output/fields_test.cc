// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/fields.h"

#include "signorini/adaptivity/error_estimator.h"

#include "../contact_bodies.h"

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace signorini;
using namespace signorini::test;

namespace
{
namespace files = std::filesystem;

/// Empty, its own.
files::path make_folder()
{
  const files::path folder = files::path(testing::TempDir()) / "signorini_fields";
  files::remove_all(folder);
  files::create_directories(folder);
  return folder;
}

std::string content_of(const files::path &path)
{
  std::ostringstream content;
  content << std::ifstream(path).rdbuf();
  return content.str();
}

/// What is written of two bodies on a floor whose contact with each other is that of surfaces or of volumes.
std::string write_fields(bool is_by_volumes, Model model = Model::neo_hookean)
{
  std::vector<BodyParameters> bodies = make_overlapping_bodies<2>();
  bodies[0].material.model = model;
  bodies[0].material.yield_stress = 1.;
  BuiltScene<2> built(bodies, 1, [](Parameters &p) { p.obstacles = {make_floor<2>(.01)}; });
  built.add_contact(make_settings(contact::Integration::face_quadrature));
  const VolumeMap<2> volume_map(built.scene, built.discretization);
  if (is_by_volumes)
  {
    built.forces.volume_contacts.push_back(std::make_shared<VolumeContactForce<2>>(
        "contact", volume_map, contact::VolumePotentialSettings(), MPI_COMM_WORLD));
    built.forces.contacts.push_back(built.forces.volume_contacts.back());
  }
  built.forces.elasticity->update(built.state);
  for (const auto &contact : built.forces.contacts)
    contact->renew(built.state);
  const ErrorEstimate estimate =
      ErrorEstimator<2>(built.discretization, built.scene, built.forces, &built.map).estimate(built.state);

  const files::path folder = make_folder();
  Fields<2> fields(folder);
  fields.set_mesh(built.discretization, &built.map);
  fields.write(built.state, built.forces, estimate);
  const std::string content = content_of(folder / "solution_0000.0.vtu");
  files::remove_all(folder);
  return content;
}

bool has(const std::string &content, const std::string &field)
{
  return content.find("Name=\"" + field + "\"") != std::string::npos;
}

TEST(Fields, ShowPlasticStrainWhereABodyMayYield)
{
  EXPECT_TRUE(has(write_fields(false, Model::plastic), "equivalent_plastic_strain"));
  EXPECT_FALSE(has(write_fields(false), "equivalent_plastic_strain"));
}

/// The volume potential knows no pressure: one that is 0 between the bodies would be wrong.
TEST(Fields, NamePressuresAfterTheContactTheyAreOf)
{
  const std::string of_surfaces = write_fields(false), of_volumes = write_fields(true);
  for (const std::string field : {"contact_pressure", "gap"})
  {
    EXPECT_TRUE(has(of_surfaces, field));
    EXPECT_FALSE(has(of_volumes, field));
  }
  for (const std::string field : {"obstacle_pressure", "obstacle_gap"})
  {
    EXPECT_FALSE(has(of_surfaces, field));
    EXPECT_TRUE(has(of_volumes, field));
  }
}

/// Every cell is in one piece, and every piece in the list.
TEST(Fields, ManyCellsComeInPieces)
{
  BuiltScene<2> built(
      {make_box("small", {1., 1., 0.}, {3, 2, 1}), make_box("large", {1., 1., 0.}, {160, 160, 1})}, 1);
  built.forces.elasticity->update(built.state);
  const ErrorEstimate estimate =
      ErrorEstimator<2>(built.discretization, built.scene, built.forces, nullptr).estimate(built.state);
  const files::path folder = make_folder();
  Fields<2> fields(folder);
  fields.set_mesh(built.discretization, nullptr);
  fields.write(built.state, built.forces, estimate);

  const std::string list = content_of(folder / "solution_0000.pvtu");
  unsigned int n_cells = 0, n_pieces = 0;
  for (const auto &entry : files::directory_iterator(folder))
    if (entry.path().extension() == ".vtu")
    {
      const std::string content = content_of(entry.path()), key = "NumberOfCells=\"";
      const unsigned int n = std::stoul(content.substr(content.find(key) + key.size()));
      EXPECT_LE(n, 25000u);
      EXPECT_NE(list.find('"' + entry.path().filename().string() + '"'), std::string::npos) << list;
      n_cells += n;
      ++n_pieces;
    }
  EXPECT_EQ(n_cells, 160u * 160u + 6u);
  EXPECT_EQ(n_pieces, 2u);
  files::remove_all(folder);
}
} // namespace
