#pragma once

#include <deal.II/base/data_out_base.h>

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <string>
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

  /** Numbers as they stand in a DataArray, compressed as they come: a head, and zlib's blocks, in base64. */
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

    /** Nothing more is added then. */
    std::string text();

  private:
    struct Deleter
    {
      void operator()(libdeflate_compressor *compressor) const;
    };

    void add_bytes(const void *bytes, std::size_t n);
    void compress();

    static constexpr std::size_t                    block_size = 1u << 18; // [byte]
    std::unique_ptr<libdeflate_compressor, Deleter> compressor;
    std::vector<unsigned char>                      block, compressed;
    std::vector<std::uint32_t>                      sizes; // of compressed blocks
    std::uint32_t                                   last_size = 0;
  };

  /** Appends to a text in parts, none of which becomes so long that its growth would cost memory. */
  void append(std::string text, std::vector<std::string> &parts);

  /**
   * Writes the texts of all ranks, one after the other, into a file. False on all ranks where that fails. Collective.
   */
  bool write_in_parallel(const std::string &path, const std::vector<std::string> &parts, MPI_Comm communicator);
} // namespace Talus
