#include <talus/postprocess/files.h>
#include <talus/postprocess/vtu.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <sstream>

#include <libdeflate.h>

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

  void VtuArray::Deleter::operator()(libdeflate_compressor *compressor) const
  {
    libdeflate_free_compressor(compressor);
  }

  VtuArray::VtuArray() : compressor(libdeflate_alloc_compressor(1)) { AssertThrow(compressor, ExcInternalError()); }

  void VtuArray::add_bytes(const void *bytes, std::size_t n)
  {
    const auto *from = static_cast<const unsigned char *>(bytes);
    while (n > 0)
    {
      const std::size_t part = std::min(n, block_size - block.size());
      block.insert(block.end(), from, from + part);
      from += part;
      n -= part;
      if (block.size() == block_size)
        compress();
    }
  }

  void VtuArray::compress()
  {
    const std::size_t begin = compressed.size();
    compressed.resize(begin + libdeflate_zlib_compress_bound(compressor.get(), block.size()));
    const std::size_t n = libdeflate_zlib_compress(compressor.get(), block.data(), block.size(), &compressed[begin],
                                                   compressed.size() - begin);
    AssertThrow(n > 0, ExcInternalError());
    compressed.resize(begin + n);
    sizes.push_back(static_cast<std::uint32_t>(n));
    last_size = static_cast<std::uint32_t>(block.size());
    block.clear();
  }

  std::string VtuArray::text()
  {
    if (!block.empty())
      compress();
    if (sizes.empty())
      return "";
    // Number of blocks, size of all but the last, of the last, compressed sizes; the blocks.
    const auto                 n_blocks = static_cast<std::uint32_t>(sizes.size());
    std::vector<std::uint32_t> head{n_blocks, n_blocks == 1 ? last_size : static_cast<std::uint32_t>(block_size),
                                    last_size};
    head.insert(head.end(), sizes.begin(), sizes.end());
    std::string text;
    append_base64(reinterpret_cast<const unsigned char *>(head.data()), sizeof(head[0]) * head.size(), text);
    append_base64(compressed.data(), compressed.size(), text);
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

    VtuArray places;
    for (const auto &patch : patches)
    {
      Assert(patch.n_subdivisions == 1 && !patch.points_are_available, ExcNotImplemented());
      for (unsigned int v = 0; v < patch.data.n_cols(); ++v)
        for (unsigned int d = 0; d < 3; ++d)
          places.add(d < spacedim ? patch.vertices[v][d] : 0.);
    }
    // The first array after the points' tag is theirs, in single precision; a rank without patches has none.
    const std::string single = "Float32";
    if (const auto tag = text.find("<Points>"); tag != std::string::npos)
    {
      const auto type = text.find(single, tag);
      text.replace(type, single.size(), "Float64");
      const auto body = text.find(">\n", type) + 2;
      text.replace(body, text.find("</DataArray>", body) - body, places.text());
    }
    return text;
  }

  void append(std::string text, std::vector<std::string> &parts)
  {
    // A string that grows copies what it holds.
    constexpr std::size_t limit = 1u << 24;
    if (parts.empty() || parts.back().size() + text.size() > limit)
      parts.push_back(std::move(text));
    else
      parts.back() += text;
  }

  bool write_in_parallel(const std::string &path, const std::vector<std::string> &parts, MPI_Comm communicator)
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

    // MPI counts in ints.
    constexpr std::size_t                             portion = 1u << 30;
    std::vector<std::pair<const char *, std::size_t>> portions;
    std::uint64_t                                     size = 0, offset = 0;
    for (const auto &part : parts)
    {
      for (std::size_t begin = 0; begin < part.size(); begin += portion)
        portions.emplace_back(part.data() + begin, std::min(portion, part.size() - begin));
      size += part.size();
    }
    MPI_Exscan(&size, &offset, 1, MPI_UINT64_T, MPI_SUM, communicator);
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      offset = 0;
    portions.resize(Utilities::MPI::max(portions.size(), communicator), {nullptr, 0});
    bool is_good = true;
    for (const auto &[from, n] : portions)
    {
      MPI_Status status;
      int        n_written = 0;
      const int  result    = MPI_File_write_at_all(file, offset, from, n, MPI_CHAR, &status);
      MPI_Get_count(&status, MPI_CHAR, &n_written);
      is_good = is_good && all(result == MPI_SUCCESS && n_written == static_cast<int>(n) ? MPI_SUCCESS : MPI_ERR_IO);
      offset += n;
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
} // namespace Talus
