#pragma once

template <int dim>
void lone_particles();

template <int dim>
void meshes();

/** n arrangements for each scheme. */
template <int dim>
void arrangements(const unsigned int n);
