#include <talus/postprocess/directory_lock.h>

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>

namespace Talus
{
  DirectoryLock::~DirectoryLock()
  {
    if (file < 0)
      return;
    unlink(path.c_str());
    close(file);
  }

  std::string DirectoryLock::take(const std::string &directory)
  {
    path = directory + "/talus.lock";
    file = open(path.c_str(), O_RDWR | O_CREAT, 0644);
    if (file < 0)
      return "cannot write into the directory '" + directory + "'. Change its permissions or choose another directory.";
    struct flock lock
    {
    };
    lock.l_type   = F_WRLCK;
    lock.l_whence = SEEK_SET;
    if (fcntl(file, F_SETLK, &lock) != 0)
    {
      const bool is_taken = errno == EACCES || errno == EAGAIN;
      close(file);
      file = -1;
      if (!is_taken)
        return "";
      std::string owner;
      std::getline(std::ifstream(path), owner);
      return "another run writes into the directory '" + directory + "': " + owner +
             ". Choose another directory, or wait for its end.";
    }
    std::array<char, 256> host{};
    gethostname(host.data(), host.size() - 1);
    const std::string owner = "process " + std::to_string(getpid()) + " on " + host.data() + '\n';
    if (ftruncate(file, 0) == 0 && write(file, owner.data(), owner.size()) < 0)
      return "cannot write '" + path + "'. Is the disk full?";
    return "";
  }
} // namespace Talus
