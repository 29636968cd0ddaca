// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/parameter_text.h"

#include "signorini/base/exceptions.h"
#include "signorini/parameters/input_file.h"
#include "signorini/parameters/strings.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace signorini
{
namespace
{
std::string location(const std::string &file, const int line)
{
  return line == 0 ? file : fmt::format("{}:{}", display_name(file), line);
}

/// What a quotation of a line that may hold anything looks like in a message.
std::string quote(const std::string &line)
{
  std::string result = line.substr(0, 60);
  for (char &character : result)
    if (static_cast<unsigned char>(character) < 32 || character == 127)
      character = '?';
  return "'" + result + (line.size() > 60 ? "…'" : "'");
}

/// Scans one file after the other (includes) into one ParameterText.
class Scanner
{
public:
  explicit Scanner(ParameterText &result) : text(result) {}
  void scan(const std::string &content, const std::string &file);

private:
  /// A line with its continuations joined and its comment removed.
  struct LogicalLine
  {
    std::string text;
    int number = 0;
  };

  bool next_line(std::istream &stream, LogicalLine &line);
  void take(const LogicalLine &line);
  void take_entry(const LogicalLine &line, const std::string &assignment);
  void take_subsection(const LogicalLine &line, const std::string &name);
  void take_end(const LogicalLine &line);
  void take_include(const LogicalLine &line, const std::string &name);
  std::string here(const int number) const { return location(files.back(), number); }

  ParameterText &text;
  std::vector<std::string> files;     ///< being read, the innermost last
  std::vector<std::string> path;      ///< open subsections
  std::vector<std::string> opened_at; ///< where each of them was opened
  std::size_t outer_depth = 0;        ///< subsections opened by including files
  int physical_line = 0;
};

void Scanner::scan(const std::string &content, const std::string &file)
{
  const std::size_t saved_depth = outer_depth;
  const int saved_line = physical_line;
  files.push_back(file);
  outer_depth = path.size();
  physical_line = 0;
  std::istringstream stream(content.compare(0, 3, "\xEF\xBB\xBF") == 0 ? content.substr(3) : content);
  for (LogicalLine line; next_line(stream, line);)
    if (!line.text.empty())
      take(line);
  if (path.size() > outer_depth)
    throw InputError(Complaint(fmt::format("subsection '{}' is not closed", path.back()))
                         .at(opened_at.back())
                         .advise("add a line 'end' behind its last entry"));
  files.pop_back();
  outer_depth = saved_depth;
  physical_line = saved_line;
}

bool Scanner::next_line(std::istream &stream, LogicalLine &line)
{
  line = {};
  for (std::string physical; std::getline(stream, physical);)
  {
    ++physical_line;
    if (line.number == 0)
      line.number = physical_line;
    const std::string part = trim(physical.substr(0, physical.find('#')));
    const bool continued = !part.empty() && part.back() == '\\';
    line.text += continued ? part.substr(0, part.size() - 1) : part;
    if (!continued)
      return true;
  }
  if (line.number > 0)
    throw InputError(Complaint("the last line ends with a backslash, but no line follows")
                         .at(here(line.number))
                         .advise("remove the backslash"));
  return false;
}

void Scanner::take(const LogicalLine &line)
{
  const std::size_t word_end = std::min(line.text.find_first_of(" \t"), line.text.size());
  const std::string word = line.text.substr(0, word_end);
  const std::string rest = trim(line.text.substr(word_end));
  if (word == "set")
    take_entry(line, rest);
  else if (word == "subsection")
    take_subsection(line, collapse_spaces(rest));
  else if (word == "end" && rest.empty())
    take_end(line);
  else if (word == "include")
    take_include(line, rest);
  else
    throw InputError(Complaint("this line is not understood")
                         .at(here(line.number))
                         .found(quote(line.text))
                         .expected("'subsection NAME', 'set KEY = VALUE', 'end', 'include FILE', '# comment'")
                         .did_you_mean(nearest_name(word, {"subsection", "set", "end", "include"}))
                         .advise("correct the line or start it with '#'"));
}

void Scanner::take_entry(const LogicalLine &line, const std::string &assignment)
{
  const std::size_t equals = assignment.find('=');
  const std::string key = collapse_spaces(trim(assignment.substr(0, equals)));
  if (equals == std::string::npos || key.empty())
    throw InputError(Complaint("'set' needs a key, '=' and a value")
                         .at(here(line.number))
                         .found(quote(line.text))
                         .advise("write 'set KEY = VALUE'"));
  const std::string joined = join(path, "/");
  if (const ParameterEntry *const first = text.find(joined, key))
    throw InputError(Complaint(fmt::format("key '{}' is set twice", key))
                         .at(here(line.number))
                         .found(fmt::format("first set at {} to {}", first->where(), quote(first->value)))
                         .advise("remove one of the two lines"));
  text.entries.push_back({joined, key, trim(assignment.substr(equals + 1)), files.back(), line.number});
}

void Scanner::take_subsection(const LogicalLine &line, const std::string &name)
{
  if (name.empty() || name.find('/') != std::string::npos)
    throw InputError(
        Complaint("'subsection' needs a name without '/'").at(here(line.number)).found(quote(line.text)));
  path.push_back(name);
  opened_at.push_back(here(line.number));
  const std::string joined = join(path, "/");
  if (const ParameterSubsection *const first = text.find_subsection(joined))
    throw InputError(Complaint(fmt::format("subsection '{}' appears twice", joined))
                         .at(here(line.number))
                         .found(fmt::format("first opened at {}", first->where()))
                         .advise("move the entries of both into one subsection"));
  text.subsections.push_back({joined, files.back(), line.number});
}

void Scanner::take_end(const LogicalLine &line)
{
  if (path.size() == outer_depth)
    throw InputError(Complaint("'end' without an open subsection")
                         .at(here(line.number))
                         .advise("remove it, or look for a missing 'subsection' above"));
  path.pop_back();
  opened_at.pop_back();
}

void Scanner::take_include(const LogicalLine &line, const std::string &name)
{
  namespace fs = std::filesystem;
  const fs::path folder = files.back() == "-" ? fs::path() : fs::path(files.back()).parent_path();
  const std::string file = (folder / name).lexically_normal().string();
  std::error_code failure;
  if (name.empty() || !fs::is_regular_file(file, failure) || !std::ifstream(file))
    throw InputError(Complaint(fmt::format("the included file '{}' cannot be read", name))
                         .at(here(line.number))
                         .found(file)
                         .advise("names are taken relative to the folder of the including file"));
  const auto is_open = [&file](const std::string &other)
  {
    std::error_code ignored;
    return fs::equivalent(file, other, ignored);
  };
  if (std::any_of(files.begin(), files.end(), is_open))
    throw InputError(Complaint(fmt::format("the file '{}' includes itself", file))
                         .at(here(line.number))
                         .found(join(files, " includes "))
                         .advise("remove this 'include'"));
  scan(read_input_file(file), file);
}
} // namespace

std::string ParameterEntry::where() const
{
  return location(file, line);
}

std::string ParameterSubsection::name() const
{
  return path.substr(path.rfind('/') + 1);
}

std::string ParameterSubsection::parent() const
{
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::string ParameterSubsection::where() const
{
  return location(file, line);
}

const ParameterEntry *ParameterText::find(const std::string &path, const std::string &key) const
{
  const auto found =
      std::find_if(entries.begin(), entries.end(),
                   [&](const ParameterEntry &entry) { return entry.path == path && entry.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

const ParameterSubsection *ParameterText::find_subsection(const std::string &path) const
{
  const auto found = std::find_if(subsections.begin(), subsections.end(),
                                  [&](const ParameterSubsection &other) { return other.path == path; });
  return found == subsections.end() ? nullptr : &*found;
}

std::string ParameterText::value(const std::string &path, const std::string &key,
                                 const std::string &fallback) const
{
  const ParameterEntry *const entry = find(path, key);
  return entry != nullptr ? entry->value : fallback;
}

std::string ParameterText::where(const std::string &path) const
{
  const ParameterSubsection *const subsection = find_subsection(path);
  return subsection != nullptr ? subsection->where() : display_name(file);
}

std::string ParameterText::where(const std::string &path, const std::string &key) const
{
  const ParameterEntry *const entry = find(path, key);
  return entry != nullptr ? entry->where() : where(path);
}

std::vector<std::string> ParameterText::names_below(const std::string &path, const std::string &prefix) const
{
  std::vector<std::string> names;
  for (const ParameterSubsection &subsection : subsections)
    if (subsection.parent() == path && subsection.name().compare(0, prefix.size(), prefix) == 0)
      names.push_back(subsection.name());
  return names;
}

std::string join_path(const std::string &path, const std::string &name)
{
  return path.empty() ? name : path + "/" + name;
}

std::string display_name(const std::string &file)
{
  return file == "-" ? "standard input" : file;
}

ParameterText scan_parameter_text(const std::string &content, const std::string &file)
{
  ParameterText text;
  text.file = file;
  Scanner(text).scan(content, file);
  if (text.entries.empty())
    throw InputError(Complaint("the parameter file has no entries")
                         .at(display_name(file))
                         .advise("'signorini --parameters' prints all that can be set"));
  return text;
}

ParameterText read_parameter_text(const std::string &file)
{
  return scan_parameter_text(file == "-" ? read_standard_input() : read_input_file(file), file);
}

void set_entry(ParameterText &text, const ParameterEntry &entry)
{
  std::string opened;
  for (const std::string &name : split(entry.path, '/'))
  {
    opened = join_path(opened, name);
    if (text.find_subsection(opened) == nullptr)
      text.subsections.push_back({opened, entry.file, entry.line});
  }
  if (const ParameterEntry *const present = text.find(entry.path, entry.key))
    text.entries[present - text.entries.data()] = entry;
  else
    text.entries.push_back(entry);
}

void remove_subsection(ParameterText &text, const std::string &path)
{
  const auto is_inside = [&path](const auto &part) { return (part.path + "/").rfind(path + "/", 0) == 0; };
  text.entries.erase(std::remove_if(text.entries.begin(), text.entries.end(), is_inside), text.entries.end());
  text.subsections.erase(std::remove_if(text.subsections.begin(), text.subsections.end(), is_inside),
                         text.subsections.end());
}

void apply_override(ParameterText &text, const std::string &override_text)
{
  const std::size_t equals = override_text.find('=');
  const std::string name = trim(override_text.substr(0, equals));
  const std::size_t slash = name.rfind('/');
  const std::string path = slash == std::string::npos ? "" : trim(name.substr(0, slash));
  const std::string key = collapse_spaces(trim(name.substr(slash == std::string::npos ? 0 : slash + 1)));
  if (equals == std::string::npos || key.empty())
    throw InputError(Complaint("an override needs a name, '=' and a value")
                         .at("--set")
                         .found("'" + override_text + "'")
                         .advise("write --set 'Body ball/Material/Density=7800'"));
  std::vector<std::string> names = split(path, '/');
  std::transform(names.begin(), names.end(), names.begin(), collapse_spaces);
  set_entry(text, {join(names, "/"), key, trim(override_text.substr(equals + 1)),
                   "--set '" + override_text + "'", 0});
}
} // namespace signorini
