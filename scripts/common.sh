# SPDX-License-Identifier: LGPL-2.1-or-later
# What scripts/run and scripts/test share; sourced by bash, does nothing by itself.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# A compiler process of this project needs about two gigabytes: no more of them than fit.
build_jobs()
{
  local cores gigabytes
  cores=$(env -u OMP_NUM_THREADS nproc) # which takes that variable for the number of cores
  gigabytes=$(awk '/^MemAvailable:/ { print int($2 / 1048576) }' /proc/meminfo)
  local fitting=$((gigabytes / 2))
  [ "$fitting" -ge 1 ] || fitting=1
  echo $((cores < fitting ? cores : fitting))
}

# Reads ninja's output and shows its counter: one line that is rewritten on a terminal, else a line now and then.
show_progress()
{
  local title=$1 line shown=$SECONDS
  while IFS= read -r line; do
    [[ $line =~ ^\[([0-9]+/[0-9]+)\] ]] || continue
    if [ -t 2 ]; then
      printf '\r\033[K%s %s' "$title" "${BASH_REMATCH[1]}" >&2
    elif [ $((SECONDS - shown)) -ge 20 ]; then
      shown=$SECONDS
      printf '%s %s\n' "$title" "${BASH_REMATCH[1]}" >&2
    fi
  done
  if [ -t 2 ]; then printf '\r\033[K' >&2; fi
}

# fail_with_log MESSAGE LOG: the end of the log is nearly always what is looked for. Exit code 4 is none of the program's.
fail_with_log()
{
  echo >&2
  tail -n 40 "$2" >&2
  echo "$1 The whole log: $2" >&2
  exit 4
}

# build PRESET TARGET...: configures once, then lets ninja decide what is left to do.
build()
{
  local preset=$1
  shift
  local folder=$root/build/$preset log=$root/build/$preset/build.log started=$SECONDS
  mkdir -p "$folder"
  # Two calls at the same time take turns.
  exec {lock}>"$root/build/lock"
  flock "$lock"
  : >"$log"
  if [ ! -f "$folder/build.ninja" ]; then
    echo "Configuring ($preset)" >&2
    (cd "$root" && cmake --preset "$preset") >>"$log" 2>&1 ||
      fail_with_log "Configuring ($preset) failed." "$log"
  fi
  cmake --build "$folder" --parallel "$(build_jobs)" --target "$@" 2>&1 |
    tee -a "$log" | show_progress "Building ($preset)" ||
    fail_with_log "Building ($preset) failed." "$log"
  exec {lock}>&-
  if [ $((SECONDS - started)) -ge 5 ]; then
    echo "Built ($preset) in $((SECONDS - started)) s; log: $log" >&2
  fi
}

# Open MPI refuses root by default, and its single-copy messages need rights that containers withhold: version 4 calls
# them vader's, version 5 smsc. All ranks are on this machine; version 5 complains of network cards that it need not use.
mpi_environment()
{
  if [ "$(id -u)" -eq 0 ]; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    export OMPI_MCA_btl_vader_single_copy_mechanism=${OMPI_MCA_btl_vader_single_copy_mechanism:-none}
    export OMPI_MCA_smsc=${OMPI_MCA_smsc:-^cma}
  fi
  export OMPI_MCA_btl_tcp_if_include=${OMPI_MCA_btl_tcp_if_include:-lo}
}

# thread_environment N_RANKS: ranks are our parallelism; alone, the dense kernels of direct solvers gain from two threads.
thread_environment()
{
  if [ "$1" -gt 1 ]; then
    export DEAL_II_NUM_THREADS=1 OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
  else
    export OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-2}
  fi
}
