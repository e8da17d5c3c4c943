#include <talus/core/exceptions.h>
#include <talus/postprocess/files.h>

#include "hdf5_writing.h"

#include <deal.II/base/mpi.h>

#include <cerrno>
#include <cstdio>

#include <fcntl.h>
#include <hdf5.h>
#include <sys/statvfs.h>
#include <unistd.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Notes whether the HDF5 library has met an error, which deal.II's interface passes over in Release builds. */
    class Hdf5Errors
    {
    public:
      Hdf5Errors()
      {
        H5Eget_auto2(H5E_DEFAULT, &before, &data_before);
        H5Eset_auto2(H5E_DEFAULT, note, this);
      }
      ~Hdf5Errors() { H5Eset_auto2(H5E_DEFAULT, before, data_before); }
      Hdf5Errors(const Hdf5Errors &) = delete;

      bool any = false;

    private:
      static herr_t note(hid_t, void *self)
      {
        static_cast<Hdf5Errors *>(self)->any = true;
        return 0;
      }

      H5E_auto2_t before      = nullptr;
      void       *data_before = nullptr;
    };

    /**
     * Whether the disk has so many bytes left, or the user's share of it: asked by taking them, and giving them back.
     * HDF5 must not find out itself: what it keeps of a file that it cannot write ends the program when MPI does.
     */
    bool has_room(const std::string &path, const std::uint64_t n_bytes)
    {
      const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
      if (file < 0)
        return false;
      const bool     is_taken = fallocate(file, 0, 0, n_bytes) == 0;
      const bool     may_be   = is_taken || errno == EOPNOTSUPP || errno == ENOSYS;
      struct statvfs space    = {};
      const bool     is_good =
        is_taken ||
        (may_be && (fstatvfs(file, &space) != 0 || static_cast<double>(space.f_bavail) * space.f_frsize > n_bytes));
      close(file);
      std::remove(path.c_str());
      return is_good;
    }
  } // namespace

  void write_hdf5_file(const std::string &path, const std::uint64_t n_bytes, const std::function<void()> &write,
                       const std::string &message, MPI_Comm communicator)
  {
    const RunError failure(message);
    // Removes what is there: MPI truncates no file.
    run_on_root([&] { AssertThrow(has_room(path, n_bytes), failure); }, communicator);
    Hdf5Errors errors;
    try
    {
      const QuietErrors quiet;
      write();
    }
    catch (const ExceptionBase &)
    {
      errors.any = true;
    }
    const bool has_failed = Utilities::MPI::logical_or(errors.any, communicator);
    if (has_failed && Utilities::MPI::this_mpi_process(communicator) == 0)
      std::remove(path.c_str());
    AssertThrow(!has_failed, failure);
  }
} // namespace Talus
