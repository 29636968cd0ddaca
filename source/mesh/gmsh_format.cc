// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/gmsh_format.h"

#include "signorini/base/exceptions.h"
#include "signorini/mesh/file_content.h"

#include <fmt/format.h>

#include <iterator>
#include <sstream>
#include <unordered_set>
#include <vector>

namespace signorini
{
namespace
{
InputError cut_off(const std::string &path, const std::string &found)
{
  return InputError(
      Complaint("the mesh file is cut off").at(path).found(found).advise("write or copy the file again"));
}

/// The lines between two marks.
std::vector<std::string> section(const std::string &content, const std::string &name)
{
  const std::size_t first = content.find('\n', content.find("$" + name)) + 1;
  std::istringstream stream(content.substr(first, content.find("$End" + name) - first));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos)
      lines.push_back(line);
  return lines;
}

std::vector<std::size_t> numbers_in(const std::string &line)
{
  std::istringstream stream(line);
  return {std::istream_iterator<std::size_t>(stream), {}};
}

/// The section begins with the number of its lines, in 4.1 with those of its blocks and of its items, which
/// have a line (nodes two) each.
void check_number_of_lines(const std::string &path, const std::string &name,
                           const std::vector<std::string> &lines, const bool has_blocks)
{
  const std::vector<std::size_t> header = numbers_in(lines.empty() ? "" : lines.front());
  if (header.size() != (has_blocks ? 4 : 1))
    throw cut_off(path, fmt::format("${} does not begin with the number of its entries", name));
  const std::size_t n_expected = has_blocks ? header[0] + header[1] * (name == "Nodes" ? 2 : 1) : header[0];
  if (lines.size() - 1 != n_expected)
    throw InputError(Complaint(fmt::format("${} has not as many entries as it says", name))
                         .at(path)
                         .found(fmt::format("{} lines", lines.size() - 1))
                         .expected(fmt::format("{} lines", n_expected))
                         .advise("write or copy the file again"));
}

void check_node_numbers(const std::string &path, const std::vector<std::string> &lines, const bool has_blocks)
{
  std::unordered_set<std::size_t> seen;
  const auto see = [&](const std::string &line)
  {
    if (const std::vector<std::size_t> number = numbers_in(line);
        !number.empty() && !seen.insert(number[0]).second)
      throw InputError(Complaint("a node stands in the file twice")
                           .at(path)
                           .found(fmt::format("node {}", number[0]))
                           .advise("remove one of the two"));
  };
  for (std::size_t line = 1; line < lines.size(); ++line)
  {
    if (!has_blocks)
    {
      see(lines[line]);
      continue;
    }
    const std::vector<std::size_t> block = numbers_in(lines[line]); // dimension, entity, parametric, nodes
    const std::size_t n_nodes = block.size() == 4 ? block[3] : 0;
    for (std::size_t node = 1; node <= n_nodes && line + node < lines.size(); ++node)
      see(lines[line + node]);
    line += 2 * n_nodes;
  }
}
} // namespace

void check_gmsh_format(const std::string &path)
{
  const std::string content = read_content(path);
  if (content.compare(0, 15, "# vtk DataFile ") == 0)
    return;
  if (content.compare(0, 11, "$MeshFormat") != 0)
    throw InputError(Complaint(content.empty() ? "the mesh file is empty" : "this is no mesh file")
                         .at(path)
                         .expected("a first line $MeshFormat (Gmsh), or # vtk DataFile (legacy VTK)")
                         .advise("write the mesh again"));
  for (const std::string mark : {"$EndMeshFormat", "$Nodes", "$EndNodes", "$Elements", "$EndElements"})
    if (content.find(mark) == std::string::npos)
      throw cut_off(path, fmt::format("no {}", mark));
  const std::vector<std::string> head = section(content, "MeshFormat");
  std::istringstream format(head.empty() ? "" : head.front());
  std::string version;
  int is_binary = 0;
  format >> version >> is_binary;
  if (version != "2.2" && version != "4.1")
    throw InputError(Complaint("this version of Gmsh's format is not read")
                         .at(path)
                         .found(version)
                         .expected("2.2 or 4.1")
                         .advise("write the mesh again: gmsh FILE -save -format msh41"));
  if (is_binary != 0)
    return;
  const bool has_blocks = version == "4.1";
  for (const std::string name : {"Nodes", "Elements"})
    check_number_of_lines(path, name, section(content, name), has_blocks);
  check_node_numbers(path, section(content, "Nodes"), has_blocks);
}
} // namespace signorini
