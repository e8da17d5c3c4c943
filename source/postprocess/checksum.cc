#include <talus/postprocess/checksum.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <vector>

namespace Talus
{
  using namespace dealii;

  void Checksum::add(const double *numbers, const std::size_t n, const std::uint64_t first_place)
  {
    for (std::size_t i = 0; i < n; ++i)
    {
      std::uint64_t word;
      std::memcpy(&word, numbers + i, sizeof(word));
      add(word, first_place + i);
    }
  }

  std::string hexadecimal(const std::uint64_t value)
  {
    char text[17];
    std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(value));
    return text;
  }

  std::uint64_t checksum_of_file(const std::string &path, const std::uint64_t n_bytes, MPI_Comm communicator)
  {
    const std::uint64_t rank           = Utilities::MPI::this_mpi_process(communicator),
                        n_ranks        = Utilities::MPI::n_mpi_processes(communicator);
    const std::uint64_t        n_words = (n_bytes + 7) / 8, end = n_words * (rank + 1) / n_ranks;
    constexpr std::uint64_t    portion = 1u << 17;
    std::vector<std::uint64_t> words(portion);
    std::ifstream              file(path, std::ios::binary);
    Checksum                   sum;
    std::uint64_t              place = n_words * rank / n_ranks;
    file.seekg(8 * place);
    while (place < end)
    {
      const std::uint64_t n = std::min(portion, end - place);
      std::fill_n(words.begin(), n, 0);
      file.read(reinterpret_cast<char *>(words.data()), std::min(8 * n, n_bytes - 8 * place));
      for (std::uint64_t i = 0; i < n; ++i)
        sum.add(words[i], place + i);
      place += n;
    }
    return Utilities::MPI::sum(sum.value(), communicator);
  }
} // namespace Talus
