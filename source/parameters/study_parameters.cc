// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/study_parameters.h"

#include "signorini/parameters/exact_solution_parameters.h"
#include "signorini/parameters/section_reader.h"
#include "signorini/parameters/strings.h"

#include <fmt/format.h>

#include <algorithm>

namespace signorini
{
namespace
{
using Factor = StudyParameters::Factor;

constexpr unsigned int longest_list = 20;

/// A list of the study.
struct FactorEntry
{
  Factor factor;
  std::string key;
  ValueRange range;
  std::string needed; ///< subsection without which the list would do nothing; may be empty
  std::string text;
};

const std::vector<FactorEntry> &factor_entries()
{
  static const std::vector<FactorEntry> entries{
      {Factor::uniform_refinements, "Uniform refinements", list_of(integer_from(0, 12), 1, longest_list), "",
       "Runs without 'Adaptivity' whose meshes are refined by so many levels more than Mesh/Refinements "
       "says."},
      {Factor::adaptive_cycles, "Adaptive cycles", list_of(integer_from(1, 100), 1, longest_list), "",
       "Further runs with 'Adaptivity' and so many 'Maximum cycles'. Without both lists all runs have the "
       "file's own mesh."},
      {Factor::degree, "Degrees", list_of(integer_from(1, 2), 1, 2), "", "Values of 'Degree'."},
      {Factor::potential, "Potentials", any_text(), "Contact",
       "Values of 'Contact/Potential', separated by commas."},
      {Factor::penalty_factor, "Penalty factors", any_text(), "Contact",
       "Values of 'Contact/Penalty factor', separated by commas."},
      {Factor::linear_solver, "Linear solvers", any_text(), "Quasi-static",
       "Values of 'Quasi-static/Linear solver', separated by commas."},
      {Factor::contact_stepping, "Contact steppings", any_text(), "Explicit",
       "Values of 'Explicit/Contact stepping', separated by commas."},
      {Factor::step_factor, "Step factors", list_of(number_above(0.), 1, longest_list), "Explicit",
       "What 'Bulk step factor' and 'Contact step factor' of 'Explicit' are multiplied by."},
      {Factor::copies, "Copies", any_text(), "",
       "Values of 'Number' of the 'Copies' of every body that has them, with spaces, separated by commas, "
       "such as 10 10 1, 10 10 10."}};
  return entries;
}

/// Empty parts cannot be told from a forgotten value.
std::vector<std::string> parts_of(const SectionReader &section, const std::string &key)
{
  const std::vector<std::string> parts = split(section.value(key), ',');
  if (std::find(parts.begin(), parts.end(), "") != parts.end())
    throw InputError(
        section.complain(key, "a value of the list is missing").advise("remove the comma, or add the value"));
  return parts;
}

bool is_same(const std::string &one, const std::string &other)
{
  const auto number = parse_number(one);
  return number ? number == parse_number(other) : one == other;
}

bool has_copies(const ParameterText &text)
{
  const std::vector<std::string> bodies = split(text.value("", "Bodies"), ',');
  return std::any_of(bodies.begin(), bodies.end(),
                     [&text](const std::string &body)
                     { return text.find_subsection("Body " + body + "/Copies") != nullptr; });
}

std::vector<std::string> read_list(const ParameterText &text, const SectionReader &section,
                                   const FactorEntry &entry)
{
  if (!entry.needed.empty() && text.find_subsection(entry.needed) == nullptr)
    throw InputError(section
                         .complain(entry.key, fmt::format("the file has no '{}' that '{}' could change",
                                                          entry.needed, entry.key))
                         .advise(fmt::format("remove the list, or add 'subsection {}'", entry.needed)));
  if (entry.factor == Factor::copies && !has_copies(text))
    throw InputError(section.complain(entry.key, "no body has 'Copies' whose number could change")
                         .advise("remove the list, or add 'subsection Copies' to a body"));
  const std::vector<std::string> values = parts_of(section, entry.key);
  for (auto value = values.begin(); value != values.end(); ++value)
    if (std::any_of(values.begin(), value, [&](const std::string &other) { return is_same(*value, other); }))
      throw InputError(section.complain(entry.key, fmt::format("'{}' stands in the list twice", *value))
                           .advise("remove one of the two; 'Repeats' repeats all runs"));
  return values;
}

/// All that errors are known of: the rows of the exact solution, then the estimates.
std::vector<std::string> known_quantities(const Parameters &parameters)
{
  std::vector<std::string> known;
  if (parameters.exact_solution)
    known = exact_solution_quantities(parameters.exact_solution->name);
  known.push_back(estimated_discretization);
  if (parameters.contact)
    known.push_back(estimated_contact);
  return known;
}

void check_quantity(const SectionReader &section, const std::string &key, const std::string &quantity,
                    const Parameters &parameters)
{
  const std::vector<std::string> known = known_quantities(parameters);
  if (std::find(known.begin(), known.end(), quantity) == known.end())
    throw InputError(section.complain(key, fmt::format("there is no quantity '{}'", quantity))
                         .expected("one of " + join(known, ", "))
                         .did_you_mean(nearest_name(quantity, known))
                         .advise(parameters.exact_solution ? "correct the name"
                                                           : "correct the name, or add 'Exact solution'"));
}

std::vector<std::string> read_quantities(const SectionReader &section, const Parameters &parameters)
{
  if (!section.given("Quantities"))
    return parameters.exact_solution ? exact_solution_quantities(parameters.exact_solution->name)
                                     : known_quantities(parameters);
  const std::vector<std::string> quantities = parts_of(section, "Quantities");
  for (const std::string &quantity : quantities)
    check_quantity(section, "Quantities", quantity, parameters);
  return quantities;
}

std::map<std::string, double> read_model_errors(const SectionReader &section, const Parameters &parameters)
{
  const std::string key = "Model errors";
  std::map<std::string, double> errors;
  for (const std::string &part : parts_of(section, key))
  {
    const std::size_t colon = part.rfind(':');
    const auto number =
        colon == std::string::npos ? std::nullopt : parse_number(trim(part.substr(colon + 1)));
    if (!number)
      throw InputError(section.complain(key, fmt::format("'{}' is not a quantity with its error", part))
                           .expected("'QUANTITY: NUMBER' separated by commas")
                           .advise("write for example 'approach: -0.0155'"));
    const std::string quantity = trim(part.substr(0, colon));
    check_quantity(section, key, quantity, parameters);
    if (!errors.emplace(quantity, *number).second)
      throw InputError(section.complain(key, fmt::format("'{}' stands in the list twice", quantity))
                           .advise("remove one of the two"));
  }
  return errors;
}
} // namespace

const std::string &study_key(const Factor factor)
{
  const auto &entries = factor_entries();
  return std::find_if(entries.begin(), entries.end(),
                      [factor](const FactorEntry &entry) { return entry.factor == factor; })
      ->key;
}

void declare_study(Declarations &declarations, const DeclarationScope &scope)
{
  if (!scope.includes("Study"))
    return;
  SubsectionDeclaration section(
      declarations, "Study",
      "Many runs, one for each combination of the values of the lists, and their errors against their run "
      "times. A list that is left out keeps the file's own value.");
  for (const FactorEntry &entry : factor_entries())
    section.add(entry.key, entry.range, "", "", entry.text);
  section.add("Repeats", integer_from(1, 100), "1", "",
              "How often every run is repeated; the smallest of the run times counts.");
  section.add("Tolerance", number_above(0.), "0.01", "",
              "The cheapest run is named whose every quantity has at most this relative error.");
  section.add(
      "Quantities", any_text(), "", "",
      "Which errors count, separated by commas: quantities of the exact solution, 'estimated "
      "discretization', 'estimated contact'; all of the exact solution, or without one the estimates, "
      "if there is no value.");
  section.add("Model errors", any_text(), "", "",
              "Known relative differences of the scene from what the exact solution assumes, as 'QUANTITY: "
              "NUMBER' separated by commas; they are taken off the relative errors.");
  section.add("Maximum dofs", integer_from(1, 1000000000), "1000000", "",
              "Runs that would have more degrees of freedom are left out; adaptive ones end refining there.");
}

StudyParameters read_study(const ParameterText &text, const Declarations &in_use,
                           const Parameters &parameters)
{
  const SectionReader section(text, in_use, "Study", 3);
  StudyParameters study;
  for (const FactorEntry &entry : factor_entries())
    if (section.given(entry.key))
      study.values[entry.factor] = read_list(text, section, entry);
  if (study.values.empty())
    throw InputError(
        section.complain("the study varies nothing")
            .expected("at least one list such as 'Uniform refinements' or 'Penalty factors' with values")
            .advise("add a list, or remove 'Study'"));
  study.n_repeats = section.integer("Repeats");
  study.tolerance = section.number("Tolerance");
  study.quantities = read_quantities(section, parameters);
  study.model_errors = read_model_errors(section, parameters);
  study.max_n_dofs = section.integer("Maximum dofs");
  return study;
}
} // namespace signorini
