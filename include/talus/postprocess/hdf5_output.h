#pragma once

#include <talus/postprocess/particle_fields.h>

#include <mpi.h>

#include <ostream>

namespace Talus
{
  /**
   * Writes the particles of all ranks into an HDF5 file, one rank after the other: `points` (n x 3) and `id` as
   * doubles, `body`, `material` and the fields in single precision, a row for each particle; `vertices` counts them. A
   * vector has three columns, a tensor the nine of its rows, symmetric ones too: readers of XDMF do not agree on the
   * order of six. Others are a data set for each component. Throws RunError on all ranks. Collective. Test:
   * tests/inputs/outputs.py (hdf5).
   */
  template <int dim>
  void write_particle_hdf5(const std::string &path, const WorkingSet<dim> &particles,
                           const std::vector<ParticleField<dim>> &fields, MPI_Comm communicator);

  /** A file of these, beside the list that names it. */
  struct Hdf5Frame
  {
    double        time;
    std::string   file;
    std::uint64_t n_particles;
  };

  /** The list of files that makes them a time series for ParaView: XDMF, version 3. */
  template <int dim>
  void write_xdmf(std::ostream &out, const std::vector<Hdf5Frame> &frames,
                  const std::vector<ParticleField<dim>> &fields);
} // namespace Talus
