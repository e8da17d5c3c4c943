#include <talus/postprocess/files.h>
#include <talus/postprocess/vtu.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <sstream>

#include <zlib.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    void append_base64(const unsigned char *bytes, const std::size_t n, std::string &text)
    {
      constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
      std::size_t    i        = 0;
      std::size_t    to       = text.size();
      text.resize(to + 4 * ((n + 2) / 3), '=');
      for (; i + 2 < n; i += 3)
      {
        const unsigned int three = bytes[i] << 16 | bytes[i + 1] << 8 | bytes[i + 2];
        for (int shift = 18; shift >= 0; shift -= 6)
          text[to++] = digits[three >> shift & 63];
      }
      if (i == n)
        return;
      const unsigned int rest = bytes[i] << 16 | (i + 1 < n ? bytes[i + 1] << 8 : 0);
      text[to++]              = digits[rest >> 18 & 63];
      text[to++]              = digits[rest >> 12 & 63];
      if (i + 1 < n)
        text[to] = digits[rest >> 6 & 63];
    }
  } // namespace

  template <class Number>
  std::string vtu_numbers(const std::vector<Number> &numbers)
  {
    if (numbers.empty())
      return "";
    // Block count, size, size of the last block, compressed size; the block.
    const uLong                n_bytes = numbers.size() * sizeof(Number);
    std::vector<unsigned char> block(compressBound(n_bytes));
    uLong                      n_compressed = block.size();
    const int                  status =
      compress2(block.data(), &n_compressed, reinterpret_cast<const Bytef *>(numbers.data()), n_bytes, Z_BEST_SPEED);
    AssertThrow(status == Z_OK, ExcInternalError());
    const std::array<std::uint32_t, 4> head = {{1, static_cast<std::uint32_t>(n_bytes),
                                                static_cast<std::uint32_t>(n_bytes),
                                                static_cast<std::uint32_t>(n_compressed)}};
    std::string                        text;
    append_base64(reinterpret_cast<const unsigned char *>(head.data()), sizeof(head), text);
    append_base64(block.data(), n_compressed, text);
    return text + '\n';
  }

  template <int dim, int spacedim>
  std::string vtu_piece(const std::vector<DataOutBase::Patch<dim, spacedim>> &patches,
                        const std::vector<std::string>                       &names,
                        const std::vector<std::tuple<unsigned int, unsigned int, std::string,
                                                     DataComponentInterpretation::DataComponentInterpretation>> &ranges,
                        const DataOutBase::VtkFlags                                                             &flags)
  {
    std::ostringstream out;
    DataOutBase::write_vtu_main(patches, names, ranges, flags, out);
    std::string text = out.str();

    std::vector<double> places;
    for (const auto &patch : patches)
    {
      Assert(patch.n_subdivisions == 1 && !patch.points_are_available, ExcNotImplemented());
      for (unsigned int v = 0; v < patch.data.n_cols(); ++v)
        for (unsigned int d = 0; d < 3; ++d)
          places.push_back(d < spacedim ? patch.vertices[v][d] : 0.);
    }
    // The first array after the points' tag is theirs, in single precision; a rank without patches has none.
    const std::string single = "Float32";
    if (const auto tag = text.find("<Points>"); tag != std::string::npos)
    {
      const auto type = text.find(single, tag);
      text.replace(type, single.size(), "Float64");
      const auto body = text.find(">\n", type) + 2;
      text.replace(body, text.find("</DataArray>", body) - body, vtu_numbers(places));
    }
    return text;
  }

  bool write_in_parallel(const std::string &path, const std::string &part, MPI_Comm communicator)
  {
    const auto all = [&](const int status) {
      return Utilities::MPI::min(status == MPI_SUCCESS ? 1 : 0, communicator) == 1;
    };
    const QuietErrors quiet;
    // A file that is there already would keep what lies beyond the new end.
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      std::remove(path.c_str());
    MPI_Barrier(communicator);
    MPI_File file;
    if (!all(MPI_File_open(communicator, path.c_str(), MPI_MODE_CREATE | MPI_MODE_WRONLY, MPI_INFO_NULL, &file)))
      return false;

    const std::uint64_t size   = part.size();
    std::uint64_t       offset = 0;
    MPI_Exscan(&size, &offset, 1, MPI_UINT64_T, MPI_SUM, communicator);
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      offset = 0;
    // MPI counts in ints.
    constexpr std::uint64_t portion = 1u << 30;
    const std::uint64_t     most    = Utilities::MPI::max(size, communicator);
    bool                    is_good = true;
    for (std::uint64_t begin = 0; begin < most; begin += portion)
    {
      const std::uint64_t from = std::min(begin, size), n = std::min(size - from, portion);
      MPI_Status          status;
      int                 n_written = 0;
      const int           result = MPI_File_write_at_all(file, offset + from, part.data() + from, n, MPI_CHAR, &status);
      MPI_Get_count(&status, MPI_CHAR, &n_written);
      is_good = is_good && all(result == MPI_SUCCESS && n_written == static_cast<int>(n) ? MPI_SUCCESS : MPI_ERR_IO);
    }
    is_good = all(MPI_File_close(&file)) && is_good;
    if (!is_good && Utilities::MPI::this_mpi_process(communicator) == 0)
      std::remove(path.c_str());
    return is_good;
  }

#define INSTANTIATE(dim, spacedim)                                                                                     \
  template std::string vtu_piece(                                                                                      \
    const std::vector<DataOutBase::Patch<dim, spacedim>> &, const std::vector<std::string> &,                          \
    const std::vector<std::tuple<unsigned int, unsigned int, std::string,                                              \
                                 DataComponentInterpretation::DataComponentInterpretation>> &,                         \
    const DataOutBase::VtkFlags &);
  INSTANTIATE(2, 2)
  INSTANTIATE(3, 3)
#undef INSTANTIATE
  template std::string vtu_numbers(const std::vector<float> &);
  template std::string vtu_numbers(const std::vector<double> &);
  template std::string vtu_numbers(const std::vector<std::int32_t> &);
  template std::string vtu_numbers(const std::vector<std::uint8_t> &);
} // namespace Talus
