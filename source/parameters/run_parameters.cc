// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/run_parameters.h"

#include "signorini/parameters/section_reader.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>

namespace signorini
{
namespace
{
const NameTable<QuasiStaticParameters::LinearSolver> &linear_solvers()
{
  static const NameTable<QuasiStaticParameters::LinearSolver> table{
      {"automatic", QuasiStaticParameters::LinearSolver::automatic},
      {"direct", QuasiStaticParameters::LinearSolver::direct},
      {"cg ic", QuasiStaticParameters::LinearSolver::cg_ic},
      {"cg amg", QuasiStaticParameters::LinearSolver::cg_amg}};
  return table;
}

const NameTable<ExplicitParameters::ContactStepping> &contact_steppings()
{
  static const NameTable<ExplicitParameters::ContactStepping> table{
      {"explicit", ExplicitParameters::ContactStepping::explicit_forces},
      {"implicit", ExplicitParameters::ContactStepping::implicit_forces}};
  return table;
}

/// An entry with the member that it fills.
template <typename Run>
struct RunEntry
{
  std::string key;
  ValueRange range;
  std::string default_value;
  std::string unit;
  std::string text;
  std::variant<double Run::*, unsigned int Run::*> member;
};

const std::vector<RunEntry<QuasiStaticParameters>> &quasi_static_entries()
{
  using Run = QuasiStaticParameters;
  static const std::vector<RunEntry<Run>> entries{
      {"End time", positive_number(), "1", "s", "Time t of the last load step; it only enters the formulas.",
       &Run::end_time},
      {"Load steps", integer_from(1, 1000000), "1", "",
       "Equal steps from time 0 to the end time, halved on the way where that is needed.", &Run::load_steps},
      {"Tolerance", number_above_up_to(0., largest_newton_tolerance), "1e-9", "",
       "Largest residual force of any body, relative to the root of the sum of squares of that body's own "
       "forces; above 1e-2 Newton's method would stop before it has found which points touch.",
       &Run::tolerance},
      {"Maximum iterations", integer_from(1, 10000), "50", "", "Newton iterations in one load step.",
       &Run::max_iterations},
      {"Maximum bisections", integer_from(0, 30), "8", "", "How often a load step that fails is halved.",
       &Run::max_bisections}};
  return entries;
}

const std::vector<RunEntry<ExplicitParameters>> &explicit_entries()
{
  using Run = ExplicitParameters;
  static const std::vector<RunEntry<Run>> entries{
      {"End time", positive_number(), "1", "s", "Length of the run.", &Run::end_time},
      {"Bulk step factor", number_above_up_to(0., 1.), "0.9", "",
       "Time step as a share of the stability bound of the bodies alone.", &Run::bulk_step_factor},
      {"Contact step factor", number_between(0., 1.), "0.5", "",
       "Time step as a share of the bound with contact springs; unilateral contact needs less than 1.",
       &Run::contact_step_factor},
      {"Ledger tolerance", number_above(0.), "0.05", "",
       "The run stops when the energy ledger is open by more than this share of the largest energy.",
       &Run::ledger_tolerance}};
  return entries;
}

const std::vector<RunEntry<ImplicitParameters>> &implicit_entries()
{
  using Run = ImplicitParameters;
  static const std::vector<RunEntry<Run>> entries{
      {"End time", positive_number(), "1", "s", "Length of the run.", &Run::end_time},
      {"Maximum bisections", integer_from(0, 40), "12", "",
       "How often a step that fails, goes too deep or is too unsteady is halved.", &Run::max_bisections},
      {"Step tolerance", number_from(0.), "0", "",
       "Largest part of the largest speed by which the change of velocities in a step may differ from that "
       "in the "
       "one before; longer steps are halved. 0: steps are not shortened for this.",
       &Run::step_tolerance},
      {"Tolerance", number_above_up_to(0., largest_newton_tolerance), "1e-9", "",
       "Largest residual force of any body, relative to the root of the sum of squares of that body's own "
       "forces.",
       &Run::tolerance},
      {"Maximum iterations", integer_from(1, 10000), "50", "", "Newton iterations in one step.",
       &Run::max_iterations},
      {"Ledger tolerance", number_above(0.), "0.05", "",
       "The run stops when the energy ledger is open by more than this share of the largest energy; a step "
       "that opens it by a tenth of this is halved.",
       &Run::ledger_tolerance}};
  return entries;
}

using AdaptivityEntries = std::vector<RunEntry<AdaptivityParameters>>;

const AdaptivityEntries &quasi_static_adaptivity_entries()
{
  using Run = AdaptivityParameters;
  static const AdaptivityEntries entries{
      {"Maximum cycles", integer_from(1, 100), "8", "",
       "Quasi-static: how often in one load step the mesh is refined where the estimated error is large, and "
       "the equilibrium found anew.",
       &Run::max_cycles},
      {"Target error", number_from(0.), "0", "",
       "Quasi-static: refining ends when the estimated relative error in the energy norm is below; 0: after "
       "the cycles.",
       &Run::target_error}};
  return entries;
}

const AdaptivityEntries &explicit_adaptivity_entries()
{
  using Run = AdaptivityParameters;
  static const AdaptivityEntries entries{
      {"Interval", integer_from(1, 1000000), "20", "",
       "Explicit: time steps from one adaptation to the next. Cells that may come into contact before the "
       "next one are refined to the last level, and stay so while in contact.",
       &Run::interval},
      {"Maximum levels", integer_from(1, 10), "2", "",
       "Explicit: how often a cell of the file's mesh may be refined. Every level halves the time step.",
       &Run::max_levels}};
  return entries;
}

const AdaptivityEntries &common_adaptivity_entries()
{
  using Run = AdaptivityParameters;
  static const AdaptivityEntries entries{
      {"Refine share", number_from_up_to(0., 1.), "0.5", "",
       "The cells with the largest errors are refined, so many that they hold this share of the squared "
       "error of the whole scene. Explicit: 0 refines for contact only.",
       &Run::refine_share},
      {"Coarsen share", number_from(0.), "0.01", "",
       "The cells with the smallest errors, so many that they hold this share, are made coarser again: "
       "quasi-static up to 'Element size' or the cells of 'Cells', before refinements; explicit up to the "
       "mesh of the file, and not while they are near contact.",
       &Run::coarsen_share},
      {"Maximum dofs", integer_from(1, 1000000000), "10000000", "",
       "Refining ends when the mesh has so many degrees of freedom.", &Run::max_n_dofs}};
  return entries;
}

template <typename Run>
void declare_entries(const std::vector<RunEntry<Run>> &entries, SubsectionDeclaration &section)
{
  for (const RunEntry<Run> &entry : entries)
    section.add(entry.key, entry.range, entry.default_value, entry.unit, entry.text);
}

template <typename Run>
void read_entries(const std::vector<RunEntry<Run>> &entries, const SectionReader &section, Run &run)
{
  for (const RunEntry<Run> &entry : entries)
    if (const auto number = std::get_if<double Run::*>(&entry.member))
      run.**number = section.number(entry.key);
    else
      run.*std::get<unsigned int Run::*>(entry.member) = section.integer(entry.key);
}

void declare_quasi_static(Declarations &declarations)
{
  SubsectionDeclaration run(
      declarations, "Quasi-static",
      "Equilibrium without inertia, in load steps; excludes 'Explicit' and 'Implicit'.");
  declare_entries(quasi_static_entries(), run);
  run.add("Linear solver", one_of(names_in(linear_solvers())), "automatic", "",
          "By size; factorisation; or conjugate gradients with incomplete Cholesky factors or algebraic "
          "multigrid, with "
          "friction GMRES with multigrid for both.");
}

void declare_explicit(Declarations &declarations)
{
  SubsectionDeclaration run(declarations, "Explicit",
                            "Motion by explicit time steps; excludes 'Quasi-static' and 'Implicit'.");
  declare_entries(explicit_entries(), run);
  run.add(
      "Contact stepping", one_of(names_in(contact_steppings())), "explicit", "",
      "Explicit: contact shortens the step the more, the higher the penalty. Implicit: the contact forces "
      "of each step are solved for, and the bodies alone set its length.");
}

void declare_implicit(Declarations &declarations)
{
  SubsectionDeclaration run(
      declarations, "Implicit",
      "Motion by implicit time steps of any length; excludes 'Quasi-static' and 'Explicit'.");
  run.add_required("Time step", positive_number(), "s", "Longest time step.");
  declare_entries(implicit_entries(), run);
  run.add("Linear solver", one_of(names_in(linear_solvers())), "automatic", "",
          "By size; factorisation; or conjugate gradients with incomplete Cholesky factors or algebraic "
          "multigrid, with "
          "friction GMRES with multigrid for both.");
}

QuasiStaticParameters read_quasi_static(const SectionReader &section)
{
  QuasiStaticParameters run;
  read_entries(quasi_static_entries(), section, run);
  run.linear_solver = section.choice("Linear solver", linear_solvers());
  return run;
}

ExplicitParameters read_explicit(const SectionReader &section)
{
  ExplicitParameters run;
  read_entries(explicit_entries(), section, run);
  run.contact_stepping = section.choice("Contact stepping", contact_steppings());
  return run;
}

ImplicitParameters read_implicit(const SectionReader &section)
{
  ImplicitParameters run;
  read_entries(implicit_entries(), section, run);
  run.time_step = section.number("Time step");
  run.linear_solver = section.choice("Linear solver", linear_solvers());
  return run;
}
} // namespace

void declare_adaptivity(Declarations &declarations, const DeclarationScope &scope)
{
  if (!scope.includes("Adaptivity"))
    return;
  SubsectionDeclaration section(declarations, "Adaptivity",
                                "Refinement of the mesh: where the estimated error is large, and in explicit "
                                "runs where contact is coming. Not with 'Implicit'.");
  const bool is_everything = scope.extent == Extent::everything;
  if (is_everything || scope.includes("Quasi-static"))
    declare_entries(quasi_static_adaptivity_entries(), section);
  if (is_everything || scope.includes("Explicit"))
    declare_entries(explicit_adaptivity_entries(), section);
  declare_entries(common_adaptivity_entries(), section);
}

AdaptivityParameters read_adaptivity(const ParameterText &text, const Declarations &in_use)
{
  AdaptivityParameters adaptivity;
  const SectionReader section(text, in_use, "Adaptivity", 3);
  const bool is_quasi_static = text.find_subsection("Quasi-static") != nullptr;
  if (is_quasi_static)
    read_entries(quasi_static_adaptivity_entries(), section, adaptivity);
  if (text.find_subsection("Explicit") != nullptr)
    read_entries(explicit_adaptivity_entries(), section, adaptivity);
  read_entries(common_adaptivity_entries(), section, adaptivity);
  if (is_quasi_static && adaptivity.refine_share == 0.)
    throw InputError(section.complain("Refine share", "a quasi-static run would refine nothing")
                         .expected("above 0")
                         .advise("raise it, or remove 'Adaptivity'"));
  if (adaptivity.refine_share + adaptivity.coarsen_share > 1.)
    throw InputError(section.complain("Coarsen share", "some cells would have to become finer and coarser")
                         .expected("at most 1 together with 'Refine share'"));
  return adaptivity;
}

void declare_solver(Declarations &declarations, const DeclarationScope &scope)
{
  if (scope.includes("Quasi-static"))
    declare_quasi_static(declarations);
  if (scope.includes("Explicit"))
    declare_explicit(declarations);
  if (scope.includes("Implicit"))
    declare_implicit(declarations);
}

std::string name_of(const SolverParameters &solver)
{
  static const std::array<std::string, 3> names{"Quasi-static", "Explicit", "Implicit"};
  return names.at(solver.index());
}

SolverParameters read_solver(const ParameterText &text, const Declarations &in_use)
{
  std::vector<std::string> present;
  for (const std::string name : {"Quasi-static", "Explicit", "Implicit"})
    if (text.find_subsection(name) != nullptr)
      present.push_back(name);
  if (present.size() > 1)
    throw InputError(Complaint(fmt::format("'{}' and '{}' contradict each other", present[0], present[1]))
                         .at(text.where(present[1]))
                         .found(fmt::format("'{}' stands at {}", present[0], text.where(present[0])))
                         .advise("remove one of the two subsections"));
  if (present.empty())
    throw InputError(Complaint("the run has none of 'Quasi-static', 'Explicit' and 'Implicit'")
                         .at(text.where(""))
                         .expected("exactly one of these subsections")
                         .advise("add one of them; the first two may be empty"));
  const SectionReader section(text, in_use, present.front(), 3);
  if (present.front() == "Quasi-static")
    return read_quasi_static(section);
  if (present.front() == "Explicit")
    return read_explicit(section);
  return read_implicit(section);
}

void declare_output(Declarations &declarations, const DeclarationScope &scope)
{
  const std::string &file = scope.text.file;
  const std::string name = file == "-" ? "standard_input" : std::filesystem::path(file).stem().string();
  SubsectionDeclaration output(declarations, "Output", "What is written, and where.");
  output.add("Directory", any_text(), "output/" + name, "",
             "Directory of all results; made if it does not exist.");
  const bool is_study = scope.text.find_subsection("Study") != nullptr;
  output.add("Number of fields", integer_from(0, 100000), is_study ? "0" : "10", "",
             "VTU files a run writes, beside the first, each at the first step (or load step) that has come "
             "to its time; the last one always. 0 by default in the runs of a 'Study'.");
  output.add("Number of statistics rows", integer_from(1, 100000000), "200", "",
             "About how many rows of statistics.csv a run in motion writes.");
}

OutputParameters read_output(const ParameterText &text, const Declarations &in_use)
{
  const SectionReader section(text, in_use, "Output", 3);
  OutputParameters output;
  output.directory = section.value("Directory");
  output.n_fields = section.integer("Number of fields");
  output.n_statistics = section.integer("Number of statistics rows");
  return output;
}
} // namespace signorini
