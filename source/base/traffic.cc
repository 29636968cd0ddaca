// SPDX-License-Identifier: LGPL-2.1-or-later
// MPI's profiling interface: what is called MPI_X here stands in front of the library's own, which is PMPI_X.
#include "signorini/base/traffic.h"

#include <mpi.h>

#include <map>
#include <mutex>

namespace signorini
{
namespace
{
Traffic total;
std::mutex mutex;
std::map<MPI_Request, std::uint64_t> bytes_of_persistent_sends;

std::uint64_t count_bytes(int count, MPI_Datatype type)
{
  int size = 0;
  MPI_Type_size(type, &size);
  return static_cast<std::uint64_t>(count) * static_cast<std::uint64_t>(size);
}

void note_message(std::uint64_t n_bytes)
{
  const std::lock_guard<std::mutex> lock(mutex);
  ++total.n_messages;
  total.n_bytes += n_bytes;
}

void note_collective(std::uint64_t n_bytes)
{
  const std::lock_guard<std::mutex> lock(mutex);
  ++total.n_collectives;
  total.n_collective_bytes += n_bytes;
}

void note_start(MPI_Request request)
{
  if (const auto send = bytes_of_persistent_sends.find(request); send != bytes_of_persistent_sends.end())
    note_message(send->second);
}
} // namespace

Traffic count_traffic()
{
  return total;
}

Traffic operator-(const Traffic &later, const Traffic &earlier)
{
  return {later.n_messages - earlier.n_messages, later.n_bytes - earlier.n_bytes,
          later.n_collectives - earlier.n_collectives, later.n_collective_bytes - earlier.n_collective_bytes};
}
} // namespace signorini

using namespace signorini;

extern "C"
{
  int MPI_Send(const void *data, int count, MPI_Datatype type, int to, int tag, MPI_Comm communicator)
  {
    note_message(count_bytes(count, type));
    return PMPI_Send(data, count, type, to, tag, communicator);
  }

  int MPI_Rsend(const void *data, int count, MPI_Datatype type, int to, int tag, MPI_Comm communicator)
  {
    note_message(count_bytes(count, type));
    return PMPI_Rsend(data, count, type, to, tag, communicator);
  }

  int MPI_Isend(const void *data, int count, MPI_Datatype type, int to, int tag, MPI_Comm communicator,
                MPI_Request *request)
  {
    note_message(count_bytes(count, type));
    return PMPI_Isend(data, count, type, to, tag, communicator, request);
  }

  int MPI_Issend(const void *data, int count, MPI_Datatype type, int to, int tag, MPI_Comm communicator,
                 MPI_Request *request)
  {
    note_message(count_bytes(count, type));
    return PMPI_Issend(data, count, type, to, tag, communicator, request);
  }

  int MPI_Irsend(const void *data, int count, MPI_Datatype type, int to, int tag, MPI_Comm communicator,
                 MPI_Request *request)
  {
    note_message(count_bytes(count, type));
    return PMPI_Irsend(data, count, type, to, tag, communicator, request);
  }

  int MPI_Send_init(const void *data, int count, MPI_Datatype type, int to, int tag, MPI_Comm communicator,
                    MPI_Request *request)
  {
    const int code = PMPI_Send_init(data, count, type, to, tag, communicator, request);
    bytes_of_persistent_sends[*request] = count_bytes(count, type);
    return code;
  }

  int MPI_Start(MPI_Request *request)
  {
    note_start(*request);
    return PMPI_Start(request);
  }

  int MPI_Startall(int count, MPI_Request requests[])
  {
    for (int i = 0; i < count; ++i)
      note_start(requests[i]);
    return PMPI_Startall(count, requests);
  }

  int MPI_Request_free(MPI_Request *request)
  {
    bytes_of_persistent_sends.erase(*request);
    return PMPI_Request_free(request);
  }

  int MPI_Allreduce(const void *from, void *to, int count, MPI_Datatype type, MPI_Op operation,
                    MPI_Comm communicator)
  {
    note_collective(count_bytes(count, type));
    return PMPI_Allreduce(from, to, count, type, operation, communicator);
  }

  int MPI_Reduce(const void *from, void *to, int count, MPI_Datatype type, MPI_Op operation, int root,
                 MPI_Comm communicator)
  {
    note_collective(count_bytes(count, type));
    return PMPI_Reduce(from, to, count, type, operation, root, communicator);
  }

  int MPI_Bcast(void *data, int count, MPI_Datatype type, int root, MPI_Comm communicator)
  {
    note_collective(count_bytes(count, type));
    return PMPI_Bcast(data, count, type, root, communicator);
  }

  int MPI_Allgather(const void *from, int count, MPI_Datatype type, void *to, int to_count,
                    MPI_Datatype to_type, MPI_Comm communicator)
  {
    note_collective(from == MPI_IN_PLACE ? count_bytes(to_count, to_type) : count_bytes(count, type));
    return PMPI_Allgather(from, count, type, to, to_count, to_type, communicator);
  }

  int MPI_Allgatherv(const void *from, int count, MPI_Datatype type, void *to, const int to_counts[],
                     const int displacements[], MPI_Datatype to_type, MPI_Comm communicator)
  {
    note_collective(from == MPI_IN_PLACE ? 0 : count_bytes(count, type));
    return PMPI_Allgatherv(from, count, type, to, to_counts, displacements, to_type, communicator);
  }

  int MPI_Barrier(MPI_Comm communicator)
  {
    note_collective(0);
    return PMPI_Barrier(communicator);
  }

  int MPI_Ibarrier(MPI_Comm communicator, MPI_Request *request)
  {
    note_collective(0);
    return PMPI_Ibarrier(communicator, request);
  }
} // extern "C"
