// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/read_parameters.h"

#include "signorini/base/exceptions.h"
#include "signorini/parameters/mesh_parameters.h"
#include "signorini/parameters/print_parameters.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace signorini
{
namespace
{
std::string data_file(const std::string &name)
{
  return std::string(SIGNORINI_UNIT_DATA) + "/" + name;
}

std::string printed(const ParameterText &text)
{
  std::ostringstream stream;
  write_parameters_used(text, stream);
  return stream.str();
}

TEST(ReadParameters, MinimalFileHasDefaults)
{
  const Parameters parameters = read_parameters(read_parameter_text(data_file("minimal.prm")));
  EXPECT_EQ(parameters.dimension, 3u);
  EXPECT_EQ(parameters.bodies.at(0).mesh.upper_corner, (Triple{1., 1., 1.}));
  EXPECT_EQ(parameters.bodies.at(0).material.density, 0.);
  EXPECT_EQ(parameters.bodies.at(0).supports.at(0).displacement[2].value(), "-0.001");
  EXPECT_FALSE(parameters.bodies.at(0).supports.at(0).displacement[0]);
  EXPECT_EQ(parameters.contact.value().penalty_factor, ContactParameters().penalty_factor);
  EXPECT_TRUE(std::holds_alternative<QuasiStaticParameters>(parameters.solver));
  EXPECT_FALSE(parameters.exact_solution);
  EXPECT_EQ(parameters.output.directory, "output/minimal");
}

TEST(ReadParameters, FillsTheStructs)
{
  const Parameters parameters = read_parameters(read_parameter_text(data_file("full.prm")));
  const BodyParameters &ball = parameters.bodies.at(0);
  EXPECT_EQ(ball.name, "ball");
  EXPECT_EQ(ball.mesh.shape, MeshParameters::Shape::ball);
  EXPECT_EQ(ball.mesh.part, MeshParameters::Part::orthant);
  EXPECT_EQ(ball.mesh.grading.value().levels, 2u);
  EXPECT_EQ(ball.placement.shift, (Triple{0., 0., 1.}));
  EXPECT_EQ(ball.material.model, MaterialParameters::Model::neo_hookean);
  EXPECT_EQ(ball.initial_spin, (Triple{0., 0., 1.}));
  EXPECT_EQ(parameters.bodies.at(1).loads.at(0).traction[2], "-1e3*sin(2*pi*t)");
  EXPECT_EQ(parameters.gravity, (Triple{0., 0., -9.81}));
  EXPECT_EQ(parameters.contact.value().excluded_pairs.at(0),
            std::pair(std::string("block"), std::string("floor")));
  EXPECT_EQ(parameters.contact.value().damping.value().damping_ratio, 0.1);
  EXPECT_EQ(std::get<ExplicitParameters>(parameters.solver).end_time, 0.1);
}

/// A folder that is there as long as the object.
struct TemporaryFolder
{
  TemporaryFolder() { std::filesystem::create_directories(path); }
  ~TemporaryFolder() { std::filesystem::remove_all(path); }
  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &operator=(const TemporaryFolder &) = delete;

  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("signorini_beside_" + std::to_string(getpid()));
};

/// Of two tetrahedra, in a file of this name, by a parameter file beside it that asks for `asked`.
MeshParameters read_mesh_beside(const std::string &name, const std::string &asked)
{
  const TemporaryFolder folder;
  std::ofstream(folder.path / name)
      << "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 1, 1, 1\n"
         "*ELEMENT, TYPE=C3D4, ELSET=a\n1, 1, 2, 3, 4\n"
         "*ELEMENT, TYPE=C3D4, ELSET=b\n2, 2, 3, 4, 5\n*SURFACE, NAME=floor\n1, S1\n";
  ParameterText text = read_parameter_text(data_file("minimal.prm"));
  text.file = (folder.path / "x.prm").string();
  remove_subsection(text, "Body block/Support top");
  for (const std::string &entry : {std::string("Shape=file"), "File=" + asked, std::string("Regions=a")})
    apply_override(text, "Body block/Mesh/" + entry);
  apply_override(text, "Body block/Support floor/z=0");
  return read_parameters(text).bodies.at(0).mesh;
}

TEST(ReadParameters, FilesAreFoundBesideTheParameterFile)
{
  const MeshParameters mesh = read_mesh_beside("two.inp", "two.inp");
  EXPECT_EQ(mesh.cell_type, MeshParameters::CellType::tetrahedra);
  ASSERT_TRUE(mesh.mesh_of_file);
  EXPECT_EQ(mesh.mesh_of_file->cells.size(), 1u);
  EXPECT_EQ(boundary_names(mesh, 3), (std::vector<std::string>{"floor", "rest"}));
  EXPECT_EQ(boundary_points(mesh, 3, "floor").size(), 3u);
  EXPECT_EQ(boundary_points(mesh, 3, "rest").size(), 4u);
}

TEST(ReadParameters, FilesAreFoundPackedOrNot)
{
  EXPECT_EQ(read_mesh_beside("two.inp", "two.inp.gz").mesh_of_file->cells.size(), 1u);
  EXPECT_EQ(read_mesh_beside("two.inp.gz", "two.inp").mesh_of_file->cells.size(), 1u);
  EXPECT_THROW(read_mesh_beside("two.inp", "one.inp.gz"), FileError);
}

TEST(ReadParameters, TetrahedraHaveAnElementSize)
{
  ParameterText text = read_parameter_text(data_file("minimal.prm"));
  apply_override(text, "Body block/Mesh/Cell type=tetrahedra");
  EXPECT_THROW(read_parameters(text), InputError);
  apply_override(text, "Body block/Mesh/Element size=0.25");
  const MeshParameters mesh = read_parameters(text).bodies.at(0).mesh;
  EXPECT_EQ(mesh.element_size, .25);
  EXPECT_EQ(mesh.cell_type, MeshParameters::CellType::tetrahedra);
}

TEST(ReadParameters, DefaultsAreThoseOfTheStructs)
{
  const Parameters parameters = read_parameters(read_parameter_text(data_file("minimal.prm")));
  const auto &read = std::get<QuasiStaticParameters>(parameters.solver);
  const QuasiStaticParameters plain;
  EXPECT_EQ(read.end_time, plain.end_time);
  EXPECT_EQ(read.load_steps, plain.load_steps);
  EXPECT_EQ(read.tolerance, plain.tolerance);
  EXPECT_EQ(read.max_iterations, plain.max_iterations);
  EXPECT_EQ(read.max_bisections, plain.max_bisections);
  EXPECT_EQ(parameters.contact.value().quadrature_points, ContactParameters().quadrature_points);
  EXPECT_EQ(parameters.output.n_fields, OutputParameters().n_fields);
  EXPECT_EQ(parameters.output.n_statistics, OutputParameters().n_statistics);
}

TEST(ReadParameters, PrintedFileReadsTheSame)
{
  for (const std::string name : {"minimal.prm", "full.prm"})
  {
    const ParameterText text = read_parameter_text(data_file(name));
    const std::string first = printed(text);
    const ParameterText again = scan_parameter_text(first, data_file(name));
    EXPECT_NO_THROW(read_parameters(again)) << name;
    EXPECT_EQ(printed(again), first);
  }
}

TEST(ReadParameters, TwoDimensions)
{
  ParameterText text = scan_parameter_text("set Dimension = 2\n"
                                           "set Bodies = disk\n"
                                           "set Gravity = 0, -9.81\n"
                                           "subsection Body disk\n"
                                           "  subsection Mesh\n"
                                           "    set Shape = ball\n"
                                           "  end\n"
                                           "  subsection Material\n"
                                           "    set Model = neo-Hookean\n"
                                           "    set Young's modulus = 1\n"
                                           "    set Poisson's ratio = 0\n"
                                           "    set Density = 1\n"
                                           "  end\n"
                                           "  subsection Initial motion\n"
                                           "    set Spin = 3\n"
                                           "  end\n"
                                           "end\n"
                                           "subsection Explicit\n"
                                           "end\n",
                                           "a.prm");
  const Parameters parameters = read_parameters(text);
  EXPECT_EQ(parameters.gravity, (Triple{0., -9.81, 0.}));
  EXPECT_EQ(parameters.bodies.at(0).initial_spin, (Triple{0., 0., 3.}));
  apply_override(text, "Gravity=0, -9.81, 0");
  EXPECT_NO_THROW(read_parameters(text));
  apply_override(text, "Body disk/Support surface/z=0");
  EXPECT_THROW(read_parameters(text), InputError);
}

TEST(ReadParameters, LeavesNoDirectoryBehind)
{
  ParameterText text = read_parameter_text(data_file("minimal.prm"));
  apply_override(text, "Output/Directory=a_directory_of_the_test/inside");
  read_parameters(text);
  EXPECT_FALSE(std::filesystem::exists("a_directory_of_the_test"));
}

TEST(PrintParameters, NamesEveryUnit)
{
  std::ostringstream stream;
  print_parameters(ParametersFormat::markdown, stream);
  EXPECT_NE(stream.str().find("| Young's modulus | Pa | required | a number ≥ 1e-30 and ≤ 1e+30 |"),
            std::string::npos);
  EXPECT_NE(stream.str().find("## Body NAME/Mesh/Grading"), std::string::npos);
}

TEST(PrintParameters, ManualIsCurrent)
{
  const std::ifstream file(data_file("../../../doc/parameters.md"));
  std::ostringstream manual;
  std::ostringstream generated;
  manual << file.rdbuf();
  print_parameters(ParametersFormat::markdown, generated);
  EXPECT_EQ(manual.str(), generated.str()) << "run signorini --parameters=md > doc/parameters.md";
}
} // namespace
} // namespace signorini
