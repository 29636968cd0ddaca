// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/study/study.h"

#include "signorini/base/exceptions.h"
#include "signorini/output/earlier_output.h"
#include "signorini/simulation/interruption.h"
#include "signorini/simulation/run.h"
#include "signorini/simulation/run_directory.h"
#include "signorini/simulation/size_estimate.h"
#include "signorini/study/memory_peak.h"

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace signorini
{
Study::Study(const CommandLine &the_command_line, const ParameterText &the_text,
             const Parameters &the_parameters, const MPI_Comm &mpi_communicator)
    : command_line(the_command_line), text(the_text), parameters(the_parameters),
      communicator(mpi_communicator),
      is_first(dealii::Utilities::MPI::this_mpi_process(mpi_communicator) == 0),
      n_ranks(dealii::Utilities::MPI::n_mpi_processes(mpi_communicator)),
      progress(is_first, the_command_line.quiet), plan(plan_study(the_text, the_parameters, n_ranks))
{
  results.input = text.file;
  results.n_ranks = n_ranks;
  results.parameters = *parameters.study;
  bool is_built = false;
  for (const StudyRun &run : plan)
    if (run.left_out.empty())
    {
      check_size(run.text, run.parameters, communicator);
      // What is wrong with the scene itself shows on the cheapest mesh.
      if (!is_built)
        signorini::print_plan(run.text, run.parameters, communicator, Screen::nothing);
      is_built = true;
      cost_left += run.cost;
    }
  if (!is_built)
    throw InputError(Complaint("all runs of the study are left out")
                         .at(text.where("Study"))
                         .found(plan.front().name() + ": " + plan.front().left_out)
                         .advise("raise Study/Maximum dofs, or begin the lists with smaller values"));
}

void Study::print_plan()
{
  progress.say(fmt::format("Study of {} runs on {} ranks; sizes are estimates, of adaptive runs those at the "
                           "start:",
                           plan.size(), n_ranks));
  for (const StudyRun &run : plan)
    progress.say(fmt::format("  {}: {}", run.name(),
                             run.left_out.empty() ? fmt::format("about {:.3g} dofs", run.n_dofs)
                                                  : "left out, " + run.left_out));
}

void Study::remove_earlier_runs() const
{
  on_first_rank(communicator,
                [this]
                {
                  for (const StudyRun &run : plan)
                    remove_earlier_output(run.parameters.output.directory);
                });
}

void Study::run()
{
  const std::string &directory = parameters.output.directory;
  const auto lock = lock_directory(directory, communicator);
  clear_directory(text, command_line.overrides, directory, communicator);
  write_parameters(text, directory, communicator);
  if (!command_line.resume)
    remove_earlier_runs();
  progress.open_log(directory, Progress::EarlierLog::replaced);
  print_plan();
  watch_for_interruption();
  std::string signal;
  for (const StudyRun &run : plan)
  {
    make(run);
    signal = interruption(communicator);
    if (!signal.empty())
      break;
  }
  finish(signal);
}

void Study::make(const StudyRun &run)
{
  StudyRow row;
  row.settings = run.settings;
  if (!run.left_out.empty())
  {
    row.status = "left out";
    row.reason = run.left_out;
    rows.push_back(row);
    progress.say(fmt::format("[{}/{}] {}: left out, {}", rows.size(), plan.size(), run.name(), run.left_out));
    return;
  }
  const bool is_earlier = dealii::Utilities::MPI::broadcast(
      communicator, command_line.resume && is_first && is_finished(run, n_ranks), 0);
  if (!is_earlier)
    simulate(run, row);
  if (is_first && row.status.empty())
    row = read_row(run, *parameters.study);
  cost_left -= run.cost;
  rows.push_back(row);
  say_row(run, row, is_earlier);
}

void Study::simulate(const StudyRun &run, StudyRow &row)
{
  const auto start = std::chrono::steady_clock::now();
  on_first_rank(communicator, [&run] { remove_earlier_output(run.parameters.output.directory); });
  if (!reset_memory_peak() && results.warnings.empty())
    results.warnings.emplace_back(
        "the kernel does not reset the peak of memory: that of a run is the largest "
        "of the runs up to it");
  try
  {
    signorini::run(run.text, run.parameters, {}, communicator, Screen::nothing, Start::anew);
  }
  catch (const NumericalError &)
  {
    // Its reason stands in the summary of the run.
  }
  catch (const InputError &error)
  {
    row.status = "failed";
    row.reason = error.what();
  }
  seconds_done += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  cost_done += run.cost;
}

void Study::say_row(const StudyRun &run, const StudyRow &row, const bool is_earlier)
{
  std::string line = fmt::format("[{}/{}] {}: ", rows.size(), plan.size(), run.name());
  if (row.status == "ok")
    line += fmt::format("{} dofs, {:.3g} s, largest error {:.2e}{}", row.n_dofs, row.run_time,
                        row.largest_error(parameters.study->quantities), is_earlier ? ", from before" : "");
  else
    line += row.status + ": " + row.reason.substr(0, row.reason.find('\n'));
  if (cost_done > 0. && rows.size() < plan.size())
    line += fmt::format("; very roughly {:.2g} s to go", seconds_done * cost_left / cost_done);
  progress.say(line);
}

void Study::finish(const std::string &signal)
{
  const auto n_with = [this](const std::string &status)
  {
    return std::count_if(rows.begin(), rows.end(),
                         [&status](const StudyRow &row) { return row.status == status; });
  };
  // Rows are known to the first rank only, and so is how many of them failed.
  const bool is_any_ok = dealii::Utilities::MPI::broadcast(communicator, n_with("ok") > 0, 0);
  results.status = !signal.empty() ? "interrupted" : is_any_ok ? "ok" : "failed";
  if (!signal.empty())
    results.reason = fmt::format("the study was interrupted by {} after {} of {} runs", signal,
                                 n_with("ok") + n_with("failed") + n_with("left out"), plan.size());
  else if (!is_any_ok)
    results.reason = "no run of the study ended well";
  if (is_first)
  {
    const auto failed =
        std::find_if(rows.begin(), rows.end(), [](const StudyRow &row) { return row.status == "failed"; });
    if (failed != rows.end())
      results.warnings.push_back(fmt::format("{} of {} runs failed; the first of them is {}: {}",
                                             n_with("failed"), plan.size(), failed->name(), failed->reason));
    compare_runs(results, rows, parameters.dimension);
    write_study_table(results, parameters.output.directory);
    write_study_summary(results, parameters.output.directory);
    for (const std::string &line : describe_study(results))
      progress.say(line);
  }
  progress.say("Output: " + parameters.output.directory);
  if (!results.reason.empty())
    throw NumericalError(
        Complaint(results.reason)
            .at(parameters.output.directory)
            .advise(signal.empty() ? "look at the reasons in its summary.json and at the logs of the runs"
                                   : "what is there is compared; run again with --resume for the rest"));
}
} // namespace signorini
