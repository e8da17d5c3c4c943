#pragma once

#include <talus/postprocess/particle_fields.h>
#include <talus/postprocess/vtu.h>

#include <mpi.h>

namespace Talus
{
  /**
   * Adds this rank's part of a VTU file: its particles as points, with id, body, material and the chosen fields. A
   * vector has three components, a symmetric tensor the six of ParaView (xx, yy, zz, xy, yz, xz), any other the nine of
   * its rows; in 2D, F_zz is 1. Places and ids are Float64: in single precision particles .25 m apart at map
   * coordinates of 4.6e6 m share their places. Test: tests/postprocess/output.cc.
   */
  template <int dim>
  void add_piece(const WorkingSet<dim> &particles, const std::vector<ParticleField<dim>> &fields, VtuText &text);

  /**
   * Writes all particles of all ranks into one table, sorted by id: id, body, material, x, y (, z)
   * and the components of `fields`. The first line is a comment with the units,
   * the second holds the names. Throws RunError on all ranks. Collective.
   */
  template <int dim>
  void write_particle_csv(const std::string &path, const WorkingSet<dim> &particles,
                          const std::vector<ParticleField<dim>> &fields, const double time, MPI_Comm communicator);
} // namespace Talus
