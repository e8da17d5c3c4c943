#include <talus/core/reduction.h>
#include <talus/core/traffic.h>

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
  } // namespace

  void reduce(std::vector<double> &maxima, std::vector<double> &sums, MPI_Comm communicator)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      return;
    std::vector<double> message(1, maxima.size());
    message.insert(message.end(), maxima.begin(), maxima.end());
    message.insert(message.end(), sums.begin(), sums.end());

    MPI_Datatype type;
    MPI_Op       operation;
    MPI_Type_contiguous(message.size(), MPI_DOUBLE, &type);
    MPI_Type_commit(&type);
    MPI_Op_create(combine, /* commutes = */ 1, &operation);
    Traffic::here().sent(message.size() * sizeof(double));
    {
      const Traffic::Wait wait;
      const int           error = MPI_Allreduce(MPI_IN_PLACE, message.data(), 1, type, operation, communicator);
      AssertThrowMPI(error);
    }
    MPI_Op_free(&operation);
    MPI_Type_free(&type);

    std::copy_n(message.begin() + 1, maxima.size(), maxima.begin());
    std::copy(message.begin() + 1 + maxima.size(), message.end(), sums.begin());
  }
} // namespace Talus
