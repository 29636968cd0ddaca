// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/abaqus_file.h"

#include "signorini/base/exceptions.h"
#include "signorini/mesh/abaqus_elements.h"
#include "signorini/mesh/abaqus_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <unordered_map>

namespace signorini
{
namespace
{
std::optional<std::size_t> parse_label(const std::string &text)
{
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size())
    return {};
  return number;
}

/// Reads the file line by line; a keyword line decides what the data lines below it mean.
class AbaqusReader
{
public:
  AbaqusReader(const std::string &path, const unsigned int dimension)
  {
    mesh.file = path;
    mesh.dimension = dimension;
  }

  FileMesh read();

private:
  /// Elements (positions in `elements`) or nodes by the upper-case name of their set.
  struct Set
  {
    std::string name; ///< as it is written where it is used first
    std::vector<std::size_t> members;
    bool is_given_with_elements = false; ///< by ELSET= of *ELEMENT
  };
  using Sets = std::vector<Set>;
  struct Element
  {
    AbaqusElementType type;
    std::size_t label;
    std::vector<std::size_t> nodes;
    unsigned int block;
  };
  /// Faces of elements, as its data lines name them.
  struct Surface
  {
    std::string name;
    std::vector<std::pair<std::vector<std::size_t>, int>>
        faces; ///< elements and local face (−1: all outer ones)
  };
  using Labels = std::unordered_map<std::size_t, std::size_t>;

  void take_keyword(const AbaqusLine &line);
  void open_elements();
  void open_surface();
  void take_data(const std::vector<std::string> &fields);
  void take_node(const std::vector<std::string> &fields);
  void take_element(const std::vector<std::string> &fields);
  void take_members(const std::vector<std::string> &fields, Sets &sets, const Labels &labels);
  void take_surface(const std::vector<std::string> &fields);
  void make_cells();
  void make_boundaries();

  Set &set_of(Sets &sets, const std::string &name) const;
  const Set *find(const Sets &sets, const std::string &name) const;
  std::vector<std::size_t> resolve(const std::string &field, const Sets &sets, const Labels &labels,
                                   const std::string &what) const;
  std::size_t label(const std::string &field, const std::string &what) const;
  [[noreturn]] void refuse(const std::string &what, const std::string &found,
                           const std::string &advice) const;

  FileMesh mesh;
  std::vector<Element> elements;
  Labels node_labels, element_labels;
  Sets element_sets, node_sets;
  std::vector<unsigned int> cell_of_element;
  std::vector<Surface> surfaces;

  AbaqusLine head; ///< the keyword line above
  AbaqusElementType type{};
  unsigned int n_blocks = 0, n_parts = 0;
  int line_number = 0;
  std::vector<std::string> unfinished; // fields of an element that goes on in the next line
};

void AbaqusReader::refuse(const std::string &what, const std::string &found, const std::string &advice) const
{
  throw InputError(
      Complaint(what).at(fmt::format("{}:{}", mesh.file, line_number)).found(found).advise(advice));
}

const AbaqusReader::Set *AbaqusReader::find(const Sets &sets, const std::string &name) const
{
  const auto found = std::find_if(
      sets.begin(), sets.end(), [&name](const Set &set) { return upper_case(set.name) == upper_case(name); });
  return found == sets.end() ? nullptr : &*found;
}

AbaqusReader::Set &AbaqusReader::set_of(Sets &sets, const std::string &name) const
{
  if (const Set *const found = find(sets, name))
    return sets[found - sets.data()];
  sets.push_back({name, {}, false});
  return sets.back();
}

std::size_t AbaqusReader::label(const std::string &field, const std::string &what) const
{
  const auto number = parse_label(field);
  if (!number)
    refuse(fmt::format("this is no number of {}", what), "'" + field + "'", "correct the line");
  return *number;
}

std::vector<std::size_t> AbaqusReader::resolve(const std::string &field, const Sets &sets,
                                               const Labels &labels, const std::string &what) const
{
  if (const auto number = parse_label(field))
  {
    const auto found = labels.find(*number);
    if (found == labels.end())
      refuse(fmt::format("there is no {} of this number", what), field,
             "correct the line; the file may be cut off");
    return {found->second};
  }
  const Set *const set = find(sets, field);
  if (set == nullptr)
    refuse(fmt::format("there is no set of {}s of this name above", what), field, "correct the line");
  return set->members;
}

FileMesh AbaqusReader::read()
{
  AbaqusLines lines(mesh.file);
  for (AbaqusLine line; lines.next(line);)
  {
    line_number = line.number;
    if (line.keyword.empty())
      take_data(line.fields);
    else
      take_keyword(line);
  }
  if (!unfinished.empty())
    refuse("the mesh file is cut off", "its last line is not complete", "write or copy the file again");
  if (elements.empty())
    throw InputError(Complaint("there are no elements")
                         .at(mesh.file)
                         .expected("*NODE and *ELEMENT")
                         .advise("check the file: it may be empty or cut off"));
  make_cells();
  make_boundaries();
  return mesh;
}

void AbaqusReader::take_keyword(const AbaqusLine &line)
{
  if (!unfinished.empty())
    refuse("an element lacks nodes",
           fmt::format("element {} has {} of {}", unfinished.front(), unfinished.size() - 1, type.n_nodes),
           "complete it; the file may be cut off");
  head = line;
  const std::string &keyword = head.keyword;
  if (keyword == "*ELEMENT")
    open_elements();
  else if (keyword == "*SURFACE")
    open_surface();
  else if (keyword == "*INCLUDE")
    refuse("*INCLUDE is not followed", head.option("INPUT"), "put the mesh into one file");
  else if (keyword == "*PART" && ++n_parts > 1)
    refuse("the file has several parts", head.option("NAME"),
           "write one part to a file; each is a body of its own");
}

/// Surfaces of nodes are passed over.
void AbaqusReader::open_surface()
{
  const std::string kind = upper_case(head.option("TYPE"));
  if (kind.empty() || kind == "ELEMENT")
    surfaces.push_back({head.option("NAME"), {}});
  else
    head.keyword = "*SURFACE OF ANOTHER TYPE";
}

void AbaqusReader::open_elements()
{
  const std::string name = upper_case(head.option("TYPE"));
  const std::optional<AbaqusElementType> found = find_abaqus_type(name);
  if (!found)
    refuse("the mesh has elements that are no simplices", "TYPE=" + name,
           mesh.dimension == 3 ? "mesh the body with C3D4 or C3D10" : "mesh the body with CPE3 or CPE6");
  if (found->dimension > mesh.dimension)
    refuse("the mesh is three-dimensional, the scene is not", "TYPE=" + name,
           "set Dimension = 3, or give a mesh of triangles");
  type = *found;
  ++n_blocks;
  if (!head.option("ELSET").empty())
  {
    const bool is_new = find(element_sets, head.option("ELSET")) == nullptr;
    Set &set = set_of(element_sets, head.option("ELSET"));
    set.is_given_with_elements = is_new || set.is_given_with_elements;
  }
}

void AbaqusReader::take_data(const std::vector<std::string> &fields)
{
  const std::string &keyword = head.keyword;
  if (keyword.empty())
    refuse("this is no Abaqus file", "text before the first keyword", "correct the ending of its name");
  if (keyword == "*NODE")
    take_node(fields);
  else if (keyword == "*ELEMENT")
    take_element(fields);
  else if (keyword == "*ELSET")
    take_members(fields, element_sets, element_labels);
  else if (keyword == "*NSET")
    take_members(fields, node_sets, node_labels);
  else if (keyword == "*SURFACE")
    take_surface(fields);
  else if (keyword == "*INSTANCE")
    refuse("a part is moved by its instance", head.option("NAME"),
           "write the mesh at its place; 'Placement' moves a body");
}

void AbaqusReader::take_node(const std::vector<std::string> &fields)
{
  Triple node{};
  const std::size_t number = label(fields.front(), "a node");
  if (fields.size() == 3 && mesh.dimension == 3)
    refuse("a node has two coordinates, the scene has Dimension = 3", fmt::format("node {}", number),
           "set Dimension = 2 for a plane mesh, or correct the line; the file may be cut off");
  if (fields.size() < mesh.dimension + 1 || fields.size() > 4)
    refuse("a node needs its number and its coordinates", fmt::format("{} fields", fields.size()),
           "correct the line; the file may be cut off");
  for (std::size_t c = 1; c < fields.size(); ++c)
  {
    char *end = nullptr;
    node[c - 1] = std::strtod(fields[c].c_str(), &end);
    if (end == fields[c].c_str() || *end != '\0')
      refuse("this is no coordinate", "'" + fields[c] + "'", "correct the line");
  }
  if (!node_labels.emplace(number, mesh.nodes.size()).second)
    refuse("a node stands in the file twice", fmt::format("node {}", number), "remove one of the two");
  if (!head.option("NSET").empty())
    set_of(node_sets, head.option("NSET")).members.push_back(mesh.nodes.size());
  mesh.nodes.push_back(node);
}

void AbaqusReader::take_element(const std::vector<std::string> &fields)
{
  unfinished.insert(unfinished.end(), fields.begin(), fields.end());
  if (unfinished.size() < type.n_nodes + 1)
    return;
  if (unfinished.size() > type.n_nodes + 1)
    refuse("an element has too many nodes", fmt::format("{} of {}", unfinished.size() - 1, type.n_nodes),
           "correct the line");
  Element element{type, label(unfinished.front(), "an element"), {}, n_blocks};
  for (std::size_t v = 1; v < unfinished.size(); ++v)
  {
    const auto found = node_labels.find(label(unfinished[v], "a node"));
    if (found == node_labels.end())
      refuse("an element has a node that is not there", "node " + unfinished[v],
             "give the node above; the file may be cut off");
    element.nodes.push_back(found->second);
  }
  unfinished.clear();
  if (!element_labels.emplace(element.label, elements.size()).second)
    refuse("an element stands in the file twice", fmt::format("element {}", element.label),
           "remove one of the two");
  if (!head.option("ELSET").empty())
    set_of(element_sets, head.option("ELSET")).members.push_back(elements.size());
  elements.push_back(element);
}

void AbaqusReader::take_members(const std::vector<std::string> &fields, Sets &sets, const Labels &labels)
{
  const std::string what = head.keyword == "*NSET" ? "node" : "element";
  std::vector<std::size_t> members;
  if (head.options.count("GENERATE") > 0)
  {
    if (fields.size() < 2 || fields.size() > 3)
      refuse("GENERATE needs first, last and step", fmt::format("{} fields", fields.size()),
             "correct the line");
    const std::size_t first = label(fields[0], what), last = label(fields[1], what),
                      step = fields.size() == 3 ? label(fields[2], what) : 1;
    if (step == 0 || last < first)
      refuse("GENERATE needs first ≤ last and a step", fields[0] + ", " + fields[1], "correct the line");
    for (std::size_t number = first; number <= last; number += step)
      if (const auto found = labels.find(number); found != labels.end())
        members.push_back(found->second);
  }
  else
    for (const std::string &field : fields)
      if (!field.empty())
      {
        const std::vector<std::size_t> more = resolve(field, sets, labels, what);
        members.insert(members.end(), more.begin(), more.end());
      }
  Set &set = set_of(sets, head.option(head.keyword.substr(1)));
  set.is_given_with_elements = false;
  set.members.insert(set.members.end(), members.begin(), members.end());
}

void AbaqusReader::take_surface(const std::vector<std::string> &fields)
{
  int face = -1;
  if (fields.size() > 1)
  {
    const std::string name = upper_case(fields[1]);
    const auto number = parse_label(name.empty() ? "" : name.substr(1));
    if (name.empty() || name[0] != 'S' || !number || *number < 1 || *number > mesh.dimension + 1)
      refuse("this is no face of a simplex", "'" + fields[1] + "'",
             fmt::format("write S1 to S{}", mesh.dimension + 1));
    face = static_cast<int>(*number) - 1;
  }
  surfaces.back().faces.emplace_back(resolve(fields[0], element_sets, element_labels, "element"), face);
}

void AbaqusReader::make_cells()
{
  constexpr unsigned int none = -1;
  cell_of_element.assign(elements.size(), none);
  for (std::size_t e = 0; e < elements.size(); ++e)
    if (elements[e].type.dimension == mesh.dimension)
    {
      FileMesh::Cell cell;
      std::copy(elements[e].nodes.begin(), elements[e].nodes.end(), cell.nodes.begin());
      cell.n_nodes = elements[e].type.n_nodes;
      cell.number = elements[e].label;
      cell.block = elements[e].block;
      cell_of_element[e] = mesh.cells.size();
      mesh.cells.push_back(cell);
    }
  for (const bool with_elements : {false, true})
    for (const Set &set : element_sets)
    {
      FileMesh::Region region{set.name, {}};
      for (const std::size_t element : set.members)
        if (cell_of_element[element] != none)
          region.cells.push_back(cell_of_element[element]);
      if (!region.cells.empty() && set.is_given_with_elements == with_elements)
        mesh.regions.push_back(region);
    }
}

void AbaqusReader::make_boundaries()
{
  const auto faces = abaqus_faces(mesh.dimension);
  for (const auto &[name, lines] : surfaces)
  {
    FileMesh::Boundary boundary{name, {}, {}, true};
    for (const auto &[members, chosen] : lines)
      for (const std::size_t element : members)
        for (int face = 0; face < static_cast<int>(faces.size()); ++face)
          if (elements[element].type.dimension == mesh.dimension && (chosen == -1 || chosen == face))
          {
            FileMesh::FaceVertices vertices{};
            for (unsigned int v = 0; v < mesh.dimension; ++v)
              vertices[v] = elements[element].nodes[faces[face][v]];
            boundary.faces.push_back(vertices);
          }
    mesh.boundaries.push_back(boundary);
  }
  for (const bool with_elements : {false, true})
    for (const Set &set : element_sets)
      if (set.is_given_with_elements == with_elements)
      {
        FileMesh::Boundary boundary{set.name, {}, {}, false};
        for (const std::size_t element : set.members)
          if (elements[element].type.dimension + 1 == mesh.dimension)
          {
            FileMesh::FaceVertices vertices{};
            std::copy_n(elements[element].nodes.begin(), mesh.dimension, vertices.begin());
            boundary.faces.push_back(vertices);
          }
        if (!boundary.faces.empty())
          mesh.boundaries.push_back(boundary);
      }
  for (const Set &set : node_sets)
    mesh.boundaries.push_back({set.name, {}, {set.members.begin(), set.members.end()}, false});
}
} // namespace

FileMesh read_abaqus_file(const std::string &path, const unsigned int dimension)
{
  return AbaqusReader(path, dimension).read();
}
} // namespace signorini
