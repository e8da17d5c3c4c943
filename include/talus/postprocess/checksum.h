#pragma once

#include <mpi.h>

#include <cstdint>
#include <string>

namespace Talus
{
  /**
   * A number that changes when any of a list of 64-bit words does, or trades places with another: the sum of their
   * scrambled values. Ranks that hold parts of the list add theirs.
   */
  class Checksum
  {
  public:
    /** Adds the word that stands at this place. */
    void add(const std::uint64_t word, const std::uint64_t place) { sum += scrambled(word ^ scrambled(place + 1)); }

    void add(const double *numbers, const std::size_t n, const std::uint64_t first_place);

    std::uint64_t value() const { return sum; }

  private:
    /** splitmix64's finalizer (Steele, Lea & Flood 2014): each bit of x moves about half of the result's. */
    static std::uint64_t scrambled(std::uint64_t x)
    {
      x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
      x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
      return x ^ (x >> 31);
    }

    std::uint64_t sum = 0;
  };

  /** Sixteen hexadecimal digits. */
  std::string hexadecimal(const std::uint64_t value);

  /** Of the first n_bytes of a file; each rank reads its share. What cannot be read counts as zeros. Collective. */
  std::uint64_t checksum_of_file(const std::string &path, const std::uint64_t n_bytes, MPI_Comm communicator);
} // namespace Talus
