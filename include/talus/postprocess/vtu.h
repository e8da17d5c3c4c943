#pragma once

#include <deal.II/base/data_out_base.h>

#include <mpi.h>

#include <string>
#include <vector>

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

  /** Numbers as they stand in a DataArray: head and one block, compressed by zlib, in base64. */
  template <class Number>
  std::string vtu_numbers(const std::vector<Number> &numbers);

  /** Writes the parts of all ranks, one after the other, into a file. False on all ranks where that fails. Collective.
   */
  bool write_in_parallel(const std::string &path, const std::string &part, MPI_Comm communicator);
} // namespace Talus
