#include <talus/postprocess/files.h>
#include <talus/postprocess/vtu.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <sstream>

#include <libdeflate.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Bytes as text: four digits for three bytes, however the bytes come. */
    class Base64
    {
    public:
      void add(const std::string &bytes, std::string &text)
      {
        std::size_t i = 0, to = text.size();
        text.resize(to + 4 * ((n_kept + bytes.size()) / 3));
        for (; n_kept > 0 && n_kept < 3 && i < bytes.size(); ++i)
          kept[n_kept++] = bytes[i];
        if (n_kept == 3)
        {
          encode(kept.data(), &text[to]);
          to += 4;
          n_kept = 0;
        }
        for (; n_kept == 0 && i + 2 < bytes.size(); i += 3, to += 4)
          encode(reinterpret_cast<const unsigned char *>(&bytes[i]), &text[to]);
        for (; i < bytes.size(); ++i)
          kept[n_kept++] = bytes[i];
      }

      void finish(std::string &text)
      {
        if (n_kept == 0)
          return;
        std::fill(kept.begin() + n_kept, kept.end(), 0);
        char four[4];
        encode(kept.data(), four);
        std::fill(four + n_kept + 1, four + 4, '=');
        text.append(four, 4);
        n_kept = 0;
      }

      static std::uint64_t length(const std::uint64_t n_bytes) { return 4 * ((n_bytes + 2) / 3); }

    private:
      static void encode(const unsigned char *bytes, char *digits)
      {
        constexpr char all[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        const unsigned three = bytes[0] << 16 | bytes[1] << 8 | bytes[2];
        for (unsigned int i = 0; i < 4; ++i)
          digits[i] = all[three >> (18 - 6 * i) & 63];
      }

      std::array<unsigned char, 3> kept{};
      unsigned int                 n_kept = 0;
    };
  } // namespace

  void VtuArray::Deleter::operator()(libdeflate_compressor *compressor) const
  {
    libdeflate_free_compressor(compressor);
  }

  VtuArray::VtuArray() : compressor(libdeflate_alloc_compressor(1)), block(block_size)
  {
    AssertThrow(compressor, ExcInternalError());
  }

  void VtuArray::add_bytes(const void *bytes, std::size_t n)
  {
    const auto *from = static_cast<const char *>(bytes);
    while (n > 0)
    {
      const std::size_t part = std::min(n, block_size - n_in_block);
      std::memcpy(&block[n_in_block], from, part);
      n_in_block += part;
      from += part;
      n -= part;
      if (n_in_block == block_size)
        compress();
    }
  }

  void VtuArray::compress()
  {
    if (n_in_block == 0)
      return;
    compressed.resize(libdeflate_zlib_compress_bound(compressor.get(), block_size));
    const std::size_t n =
      libdeflate_zlib_compress(compressor.get(), block.data(), n_in_block, compressed.data(), compressed.size());
    AssertThrow(n > 0, ExcInternalError());
    blocks.emplace_back(compressed.data(), n);
    last_size  = n_in_block;
    n_in_block = 0;
  }

  void VtuArray::finish()
  {
    compress();
    compressor.reset();
    block      = {};
    compressed = {};
  }

  std::string VtuArray::head() const
  {
    // Number of blocks, size of all but the last, of the last, compressed sizes.
    std::vector<std::uint32_t> words{static_cast<std::uint32_t>(blocks.size()),
                                     static_cast<std::uint32_t>(blocks.size() == 1 ? last_size : block_size),
                                     static_cast<std::uint32_t>(last_size)};
    for (const auto &bytes : blocks)
      words.push_back(static_cast<std::uint32_t>(bytes.size()));
    return {reinterpret_cast<const char *>(words.data()), sizeof(words[0]) * words.size()};
  }

  std::uint64_t VtuArray::length() const
  {
    std::uint64_t n_bytes = 0;
    for (const auto &bytes : blocks)
      n_bytes += bytes.size();
    return blocks.empty() ? 0 : Base64::length(head().size()) + Base64::length(n_bytes) + 1;
  }

  void VtuArray::write(const std::function<void(const std::string &)> &take) const
  {
    if (blocks.empty())
      return;
    std::string text;
    Base64      base64;
    base64.add(head(), text);
    base64.finish(text);
    for (const auto &bytes : blocks)
    {
      base64.add(bytes, text);
      take(text);
      text.clear();
    }
    base64.finish(text);
    take(text + '\n');
  }

  void VtuText::add(const std::string &text)
  {
    if (parts.empty() || parts.back().second.n_blocks() > 0)
      parts.emplace_back();
    parts.back().first += text;
  }

  void VtuText::add(VtuArray array)
  {
    array.finish();
    if (parts.empty())
      parts.emplace_back();
    if (array.n_blocks() > 0)
      parts.back().second = std::move(array);
  }

  std::uint64_t VtuText::length() const
  {
    std::uint64_t n = 0;
    for (const auto &[text, array] : parts)
      n += text.size() + array.length();
    return n;
  }

  void VtuText::write(const std::function<void(const std::string &)> &take) const
  {
    for (const auto &[text, array] : parts)
    {
      take(text);
      array.write(take);
    }
  }

  std::string VtuText::text() const
  {
    std::string all;
    write([&](const std::string &text) { all += text; });
    return all;
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

    VtuText  text_of_places;
    VtuArray places;
    for (const auto &patch : patches)
    {
      Assert(patch.n_subdivisions == 1 && !patch.points_are_available, ExcNotImplemented());
      for (unsigned int v = 0; v < patch.data.n_cols(); ++v)
        for (unsigned int d = 0; d < 3; ++d)
          places.add(d < spacedim ? patch.vertices[v][d] : 0.);
    }
    text_of_places.add(std::move(places));
    // The first array after the points' tag is theirs, in single precision; a rank without patches has none.
    const std::string single = "Float32";
    if (const auto tag = text.find("<Points>"); tag != std::string::npos)
    {
      const auto type = text.find(single, tag);
      text.replace(type, single.size(), "Float64");
      const auto body = text.find(">\n", type) + 2;
      text.replace(body, text.find("</DataArray>", body) - body, text_of_places.text());
    }
    return text;
  }

  bool write_in_parallel(const std::string &path, const VtuText &text, MPI_Comm communicator)
  {
    const auto        all = [&](const bool is_good) { return Utilities::MPI::min(is_good ? 1 : 0, communicator) == 1; };
    const QuietErrors quiet;
    // A file that is there already would keep what lies beyond the new end.
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      std::remove(path.c_str());
    MPI_Barrier(communicator);
    MPI_File file;
    if (!all(MPI_File_open(communicator, path.c_str(), MPI_MODE_CREATE | MPI_MODE_WRONLY, MPI_INFO_NULL, &file) ==
             MPI_SUCCESS))
      return false;

    const std::uint64_t length = text.length();
    std::uint64_t       offset = 0;
    MPI_Exscan(&length, &offset, 1, MPI_UINT64_T, MPI_SUM, communicator);
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      offset = 0;
    const std::uint64_t   end     = offset + length;
    constexpr std::size_t portion = 1u << 22; // few calls, little memory; MPI counts in ints
    bool                  is_good = true;
    std::string           kept;
    const auto            write = [&]() {
      MPI_Status status;
      int        n_written = 0;
      const int  n         = static_cast<int>(kept.size());
      const int  result    = MPI_File_write_at(file, offset, kept.data(), n, MPI_CHAR, &status);
      MPI_Get_count(&status, MPI_CHAR, &n_written);
      is_good = is_good && result == MPI_SUCCESS && n_written == n;
      offset += n;
      kept.clear();
    };
    text.write([&](const std::string &part) {
      for (std::size_t begin = 0; begin < part.size(); begin += portion)
      {
        kept.append(part, begin, portion);
        if (kept.size() >= portion)
          write();
      }
    });
    write();
    is_good = all(is_good && offset == end);
    is_good = all(MPI_File_close(&file) == MPI_SUCCESS) && is_good;
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
