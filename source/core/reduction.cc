#include <talus/core/reduction.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Talus
{
  namespace
  {
    // The message: the number of maxima, the maxima, the sums. It is one element
    // of a contiguous type, so MPI never splits it.
    void combine(void *in, void *inout, int *, MPI_Datatype *type)
    {
      int bytes;
      MPI_Type_size(*type, &bytes);
      const auto *a        = static_cast<const double *>(in);
      auto       *b        = static_cast<double *>(inout);
      const int   n        = bytes / sizeof(double);
      const int   n_maxima = static_cast<int>(b[0]);
      for (int i = 1; i <= n_maxima; ++i)
        b[i] = std::max(a[i], b[i]);
      for (int i = n_maxima + 1; i < n; ++i)
        b[i] += a[i];
    }

    /** Replaces a message by that of all ranks. */
    void reduce(std::vector<double> &message, const Communicator &communicator)
    {
      MPI_Datatype type;
      MPI_Op       operation;
      MPI_Type_contiguous(message.size(), MPI_DOUBLE, &type);
      MPI_Type_commit(&type);
      MPI_Op_create(combine, /* commutes = */ 1, &operation);
      communicator.sent(message.size() * sizeof(double));
      {
        const Communicator::Wait wait(communicator);
        const int                error = MPI_Allreduce(MPI_IN_PLACE, message.data(), 1, type, operation, communicator);
        AssertThrowMPI(error);
      }
      MPI_Op_free(&operation);
      MPI_Type_free(&type);
    }
  } // namespace

  void Reduction::run(const Communicator &communicator)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      return;
    std::vector<double> message(1, maxima.size() + flags.size());
    for (const double *value : maxima)
      message.push_back(*value);
    for (const bool *flag : flags)
      message.push_back(*flag);
    for (const double *value : sums)
      message.push_back(*value);
    reduce(message, communicator);

    auto next = message.begin() + 1;
    for (double *value : maxima)
      *value = *next++;
    for (bool *flag : flags)
      *flag = *next++ > 0;
    for (double *value : sums)
      *value = *next++;
  }
} // namespace Talus
