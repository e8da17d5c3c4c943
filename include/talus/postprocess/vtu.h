#pragma once

#include <deal.II/base/data_out_base.h>

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

struct libdeflate_compressor;

namespace Talus
{
  /**
   * deal.II's text of one rank's part of a VTU file, with places as Float64: in single precision nodes .25 m apart at
   * map coordinates of 4.6e6 m share their places. Test: tests/postprocess/output.cc.
   */
  template <int dim, int spacedim>
  std::string vtu_piece(
    const std::vector<dealii::DataOutBase::Patch<dim, spacedim>> &patches, const std::vector<std::string> &names,
    const std::vector<std::tuple<unsigned int, unsigned int, std::string,
                                 dealii::DataComponentInterpretation::DataComponentInterpretation>> &ranges,
    const dealii::DataOutBase::VtkFlags                                                             &flags);

  /** Numbers of a DataArray, compressed as they come; as text a head and zlib's blocks, both in base64. */
  class VtuArray
  {
  public:
    VtuArray();

    template <class Number>
    void add(const Number *numbers, const std::size_t n)
    {
      add_bytes(numbers, n * sizeof(Number));
    }

    template <class Number>
    void add(const Number number)
    {
      add_bytes(&number, sizeof(Number));
    }

    /** Nothing more is added: what is of no use any more is freed. */
    void finish();

    std::size_t   n_blocks() const { return blocks.size(); }
    std::uint64_t length() const; // of the text
    void          write(const std::function<void(const std::string &)> &take) const;

  private:
    struct Deleter
    {
      void operator()(libdeflate_compressor *compressor) const;
    };

    void        add_bytes(const void *bytes, std::size_t n);
    void        compress();
    std::string head() const;

    static constexpr std::size_t                    block_size = 1u << 18; // [byte]
    std::unique_ptr<libdeflate_compressor, Deleter> compressor;
    std::vector<char>                               block, compressed;
    std::vector<std::string>                        blocks;
    std::size_t                                     n_in_block = 0, last_size = 0;
  };

  /** The text of a file: arrays stay compressed until it is written. */
  class VtuText
  {
  public:
    void          add(const std::string &text);
    void          add(VtuArray array);
    std::uint64_t length() const;

    /** Hands over all of it, part after part. */
    void        write(const std::function<void(const std::string &)> &take) const;
    std::string text() const;

  private:
    std::vector<std::pair<std::string, VtuArray>> parts;
  };

  /**
   * Writes the texts of all ranks, one after the other, into a file. False on all ranks where that fails. Collective.
   */
  bool write_in_parallel(const std::string &path, const VtuText &text, MPI_Comm communicator);
} // namespace Talus
