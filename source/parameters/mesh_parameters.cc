// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/mesh_parameters.h"

#include "signorini/mesh/file_content.h"
#include "signorini/mesh/geometry_file.h"
#include "signorini/mesh/read_mesh_file.h"
#include "signorini/parameters/section_reader.h"
#include "signorini/parameters/strings.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

namespace signorini
{
namespace
{
const NameTable<MeshParameters::Shape> &shapes()
{
  static const NameTable<MeshParameters::Shape> table{{"box", MeshParameters::Shape::box},
                                                      {"ball", MeshParameters::Shape::ball},
                                                      {"cylinder", MeshParameters::Shape::cylinder},
                                                      {"file", MeshParameters::Shape::file}};
  return table;
}

const NameTable<MeshParameters::CellType> &cell_types(const unsigned int dimension)
{
  using CellType = MeshParameters::CellType;
  static const NameTable<CellType> solids{{"hexahedra", CellType::hexahedra},
                                          {"tetrahedra", CellType::tetrahedra}};
  static const NameTable<CellType> plane{{"quadrilaterals", CellType::hexahedra},
                                         {"triangles", CellType::tetrahedra}};
  return dimension == 3 ? solids : plane;
}

/// Which entries a mesh has.
enum class MeshKind
{
  hexahedra,
  cut_box, ///< of tetrahedra, by its cells
  generated_tetrahedra,
  mesh_file
};

MeshKind kind_of(const ParameterText &text, const unsigned int dimension, const std::string &path)
{
  if (text.value(path, "Shape") == "file")
    return is_geometry_file(text.value(path, "File")) ? MeshKind::generated_tetrahedra : MeshKind::mesh_file;
  const bool has_tetrahedra = text.value(path, "Cell type") == cell_types(dimension)[1].first;
  if (!has_tetrahedra)
    return MeshKind::hexahedra;
  const bool is_cut = text.value(path, "Shape", "box") == "box" && text.find(path, "Cells") != nullptr &&
                      text.find(path, "Element size") == nullptr;
  return is_cut ? MeshKind::cut_box : MeshKind::generated_tetrahedra;
}

const NameTable<MeshParameters::Part> &parts()
{
  static const NameTable<MeshParameters::Part> table{{"whole", MeshParameters::Part::whole},
                                                     {"half", MeshParameters::Part::half},
                                                     {"orthant", MeshParameters::Part::orthant}};
  return table;
}

void declare_grading(Declarations &declarations, const DeclarationScope &scope, const std::string &path)
{
  SubsectionDeclaration grading(declarations, path, "Smaller cells near a point or a boundary.");
  grading.add("Point", scope.vector(), "", "m",
              "Centre of refinement, in the body's coordinates before placement.");
  grading.add("Boundary", any_text(), "", "",
              "Boundary towards which cells are refined, instead of a point.");
  grading.add_required("Distance", positive_length(), "m",
                       "Cells nearer than this are refined by all levels.");
  grading.add("Levels", integer_from(1, 12), "1", "",
              "Additional refinements there; each level less doubles the distance.");
}

MeshParameters::Grading read_grading(const SectionReader &section, const MeshParameters &mesh,
                                     const unsigned int dimension)
{
  MeshParameters::Grading grading;
  if (section.given("Point") && section.given("Boundary"))
    throw InputError(section.complain("Boundary", "'Point' and 'Boundary' of a grading contradict each other")
                         .advise("remove one of the two"));
  if (!section.given("Point") && !section.given("Boundary"))
    throw InputError(section.complain("a grading needs 'Point' or 'Boundary'").advise("add one of the two"));
  if (section.given("Point"))
    grading.point = section.vector("Point");
  else
    grading.boundary = section.value("Boundary");
  const std::vector<std::string> names = boundary_names(mesh, dimension);
  if (grading.boundary && std::find(names.begin(), names.end(), *grading.boundary) == names.end())
    throw InputError(section.complain("Boundary", "the mesh has no such boundary")
                         .expected("one of " + join(names, ", "))
                         .did_you_mean(nearest_name(*grading.boundary, names))
                         .advise("use a boundary of this shape"));
  grading.distance = section.number("Distance");
  grading.levels = section.integer("Levels");
  return grading;
}

void read_box(const SectionReader &section, const unsigned int dimension, MeshParameters &mesh)
{
  mesh.lower_corner = section.vector("Lower corner");
  mesh.upper_corner = section.vector("Upper corner");
  if (mesh.cell_type == MeshParameters::CellType::hexahedra || section.given("Cells"))
    mesh.cells = section.integers("Cells");
  for (unsigned int c = 0; c < dimension; ++c)
    if (mesh.lower_corner[c] >= mesh.upper_corner[c])
      throw InputError(
          section
              .complain(
                  section.given("Upper corner") ? "Upper corner" : "Lower corner",
                  fmt::format("component {} of 'Upper corner' is not above that of 'Lower corner'", c + 1))
              .expected(
                  fmt::format("upper > lower; here {} and {}", mesh.upper_corner[c], mesh.lower_corner[c]))
              .advise("exchange or correct the corners"));
}

void declare_shape(SubsectionDeclaration &mesh, const DeclarationScope &scope, const std::string &path,
                   const bool has_cells)
{
  const auto shape_is = [&](const std::string &shape) { return scope.chosen(path, "Shape", shape, "box"); };
  if (shape_is("file"))
  {
    mesh.add_required(
        "File", any_text(), "",
        fmt::format("File: a mesh ({}) or a shape ({}; of STEP the unit is heeded, and becomes m); a "
                    "relative path begins at the folder of the parameter file. An .inp may be packed, as "
                    ".inp.gz: if there is none of the name given, that with or without .gz is taken.",
                    join(mesh_file_endings(), ", "), join(geometry_file_endings(), ", ")));
    mesh.add("Regions", any_text(), "", "",
             "File: names of the regions that are the body, separated by commas; absent: all of it.");
  }
  if (shape_is("ball"))
    mesh.add("Part", one_of(names_in(parts())), "whole", "",
             "Ball: all of it, the half with last coordinate ≥ 0, or the part with all coordinates ≥ 0.");
  if (shape_is("box"))
  {
    mesh.add("Lower corner", scope.vector(), scope.components("0, 0, 0"), "m", "Box: smallest coordinates.");
    mesh.add("Upper corner", scope.vector(), scope.components("1, 1, 1"), "m", "Box: largest coordinates.");
    if (has_cells)
      mesh.add("Cells", list_of(integer_from(1, 1000000), scope.dimension, scope.dimension),
               scope.components("1, 1, 1"), "",
               "Box: coarse cells in each direction; each is cut into 6 tetrahedra (2 triangles) where the "
               "box is of "
               "these and has no Element size.");
  }
  if (shape_is("ball") || shape_is("cylinder"))
    mesh.add("Radius", positive_length(), "1", "m", "Ball and cylinder: radius.");
  if (shape_is("cylinder"))
    mesh.add("Length", positive_length(), "1", "m", "Cylinder: length along the z axis.");
}

/// The path as it can be opened: relative ones begin at the folder of the file in which they stand.
std::string find_path(const ParameterText &text, const std::string &path)
{
  const ParameterEntry &entry = *text.find(path, "File");
  const std::filesystem::path parameter_file = entry.line > 0 ? entry.file : text.file;
  return (parameter_file.parent_path() / entry.value).string();
}

/// The first of the file's possible names that exists.
std::string find_file(const SectionReader &section, const std::string &path)
{
  const std::vector<std::string> names = possible_names(path);
  const auto found = std::find_if(names.begin(), names.end(),
                                  [](const std::string &name)
                                  {
                                    std::error_code ignored;
                                    return std::filesystem::exists(name, ignored);
                                  });
  if (found == names.end())
    throw FileError(
        section
            .complain("File", names.size() == 1
                                  ? fmt::format("the file '{}' does not exist", names[0])
                                  : fmt::format("neither '{}' nor '{}' exists", names[0], names[1]))
            .advise("correct the name; it is looked for beside the parameter file"));
  return *found;
}

std::vector<std::string> read_regions(const SectionReader &section)
{
  const std::vector<std::string> names = split(section.value("Regions"), ',');
  for (auto name = names.begin(); name != names.end(); ++name)
    if (std::find(names.begin(), name, *name) != name)
      throw InputError(section.complain("Regions", fmt::format("'{}' stands in the list twice", *name))
                           .advise("remove one of the two"));
  return names;
}

void read_file(const ParameterText &text, const SectionReader &section, const unsigned int dimension,
               MeshParameters &mesh)
{
  mesh.file = find_path(text, section.path());
  mesh.regions = read_regions(section);
  if (!is_mesh_file(mesh.file) && !is_geometry_file(mesh.file))
    throw InputError(section.complain("File", "the ending of the name tells no format that is read")
                         .expected(join(mesh_file_endings(), ", ") + " (meshes), " +
                                   join(geometry_file_endings(), ", ") + " (shapes)")
                         .advise("convert the file, or correct the ending of its name"));
  mesh.file = find_file(section, mesh.file);
  if (is_mesh_file(mesh.file))
    mesh.mesh_of_file =
        std::make_shared<const SimplexMesh>(read_mesh_file(mesh.file, dimension, mesh.regions));
  else
    mesh.surface_of_file =
        std::make_shared<const SimplexMesh>(read_geometry_file(mesh.file, dimension, mesh.regions));
}

double read_element_size(const SectionReader &section, const MeshParameters &mesh,
                         const unsigned int dimension)
{
  const double size = section.number("Element size"), largest = largest_extent(mesh, dimension);
  if (size > largest)
    throw InputError(
        section.complain("Element size", "the elements are larger than the shape")
            .expected(fmt::format("> 0 and ≤ {:.6g} m, the largest extent of the shape", largest))
            .advise("lower 'Element size', or correct the dimensions of the shape; all are in m"));
  return size;
}

MeshParameters::CellType read_cell_type(const SectionReader &section, const MeshParameters::Shape shape,
                                        const unsigned int dimension)
{
  const NameTable<MeshParameters::CellType> &table = cell_types(dimension);
  if (shape != MeshParameters::Shape::file)
    return section.choice("Cell type", table);
  if (section.given("Cell type") && section.choice("Cell type", table) == MeshParameters::CellType::hexahedra)
    throw InputError(section.complain("Cell type", fmt::format("a mesh from a file has {}", table[1].first))
                         .expected(table[1].first)
                         .advise("remove 'Cell type', or generate a box, ball or cylinder"));
  return MeshParameters::CellType::tetrahedra;
}

void read_shape(const ParameterText &text, const SectionReader &section, const unsigned int dimension,
                MeshParameters &mesh)
{
  switch (mesh.shape)
  {
  case MeshParameters::Shape::file:
    read_file(text, section, dimension, mesh);
    break;
  case MeshParameters::Shape::box:
    read_box(section, dimension, mesh);
    break;
  case MeshParameters::Shape::cylinder:
    mesh.radius = section.number("Radius");
    mesh.length = section.number("Length");
    break;
  case MeshParameters::Shape::ball:
    mesh.radius = section.number("Radius");
    mesh.part = section.choice("Part", parts());
    break;
  }
}
} // namespace

void declare_mesh(Declarations &declarations, const DeclarationScope &scope, const std::string &path)
{
  const bool all = scope.extent == Extent::everything;
  const MeshKind kind = kind_of(scope.text, scope.dimension, path);
  const std::vector<std::string> types = names_in(cell_types(scope.dimension));
  SubsectionDeclaration mesh(
      declarations, path,
      "A generated mesh of hexahedra or tetrahedra (in 2-D quadrilaterals or triangles), or one "
      "of tetrahedra (triangles) from a file.");
  mesh.add(
      "Shape", one_of(names_in(shapes())), "box", "",
      "Box; ball centred at the origin; cylinder centred at the origin around the z axis (3-D only); or what "
      "stands in a file.");
  mesh.add("Cell type", one_of(types), types[!all && scope.chosen(path, "Shape", "file", "box") ? 1 : 0], "",
           "What the mesh is made of; in 2-D quadrilaterals or triangles. From a file always tetrahedra "
           "(triangles).");
  declare_shape(mesh, scope, path, all || kind == MeshKind::hexahedra || kind == MeshKind::cut_box);
  if (all || kind == MeshKind::generated_tetrahedra)
    mesh.add_required(
        "Element size", positive_length(), "m",
        "Tetrahedra, but not from mesh files, nor of boxes with Cells: length of their edges, before "
        "Refinements and Grading.");
  if (all || kind != MeshKind::mesh_file)
    mesh.add("Refinements", integer_from(0, 12), "0", "",
             "How often all coarse cells are halved in each direction; of tetrahedra: Element size. Not of "
             "mesh files.");
  if (scope.includes(join_path(path, "Grading")))
    declare_grading(declarations, scope, join_path(path, "Grading"));
}

MeshParameters read_mesh(const ParameterText &text, const Declarations &in_use, const std::string &path,
                         const unsigned int dimension)
{
  const SectionReader section(text, in_use, path, dimension);
  MeshParameters mesh;
  mesh.shape = section.choice("Shape", shapes());
  if (mesh.shape == MeshParameters::Shape::cylinder && dimension == 2)
    throw InputError(section.complain("Shape", "a cylinder needs three dimensions")
                         .expected("box, ball or file in two dimensions")
                         .advise("set Dimension = 3, or use a ball: in two dimensions it is a disk"));
  mesh.cell_type = read_cell_type(section, mesh.shape, dimension);
  read_shape(text, section, dimension, mesh);
  const std::string grading = join_path(path, "Grading");
  if (mesh.mesh_of_file)
  {
    if (text.find_subsection(grading) != nullptr)
      throw InputError(
          SectionReader(text, in_use, grading, dimension)
              .complain("a mesh from a file cannot be graded")
              .found(fmt::format("File = {}", section.value("File")))
              .advise("remove 'Grading', and make the mesh as fine as is needed where it was made"));
    return mesh;
  }
  const bool is_cut_box =
      mesh.cell_type == MeshParameters::CellType::tetrahedra && !section.given("Element size");
  if (is_cut_box && text.find_subsection(grading) != nullptr)
    throw InputError(SectionReader(text, in_use, grading, dimension)
                         .complain("a box of tetrahedra with 'Cells' cannot be graded")
                         .advise("give 'Element size' instead of 'Cells'"));
  if (mesh.cell_type == MeshParameters::CellType::tetrahedra && !is_cut_box)
    mesh.element_size = read_element_size(section, mesh, dimension);
  mesh.refinements = section.integer("Refinements");
  if (text.find_subsection(grading) != nullptr)
    mesh.grading = read_grading(SectionReader(text, in_use, grading, dimension), mesh, dimension);
  return mesh;
}

bool is_adaptable(const MeshParameters &mesh, bool is_in_motion)
{
  return mesh.cell_type != MeshParameters::CellType::tetrahedra || !(is_in_motion || mesh.mesh_of_file);
}
} // namespace signorini
