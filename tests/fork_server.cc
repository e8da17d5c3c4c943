// Preloaded into a program of which many runs are wanted: it stops before main() and makes a copy of itself for each
// request, so that 200 libraries are linked once and not a thousand times. A request is lines on stdin: the directory,
// the files for stdout and stderr, the number of arguments, the arguments. Answers on stdout: the process id, then at its
// end the status of waitpid() and the processor time [s].

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace
{
  std::vector<std::string> arguments;
  std::vector<char *>      pointers;

  /** In the copy: what the program finds is what the request says. */
  void become(const std::string &directory, const std::string &out_name, const std::string &err_name, char *program)
  {
    setpgid(0, 0);
    if (chdir(directory.c_str()) != 0)
      _exit(99);
    dup2(open("/dev/null", O_RDONLY), 0);
    dup2(open(out_name.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), 1);
    dup2(open(err_name.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), 2);
    pointers.assign(1, program);
    for (auto &argument : arguments)
      pointers.push_back(&argument[0]);
    pointers.push_back(nullptr);
  }

  /** Returns in copies alone. */
  void serve(char *program)
  {
    std::string directory, out, err, line;
    while (std::getline(std::cin, directory) && std::getline(std::cin, out) && std::getline(std::cin, err) &&
           std::getline(std::cin, line))
    {
      arguments.assign(std::atoi(line.c_str()), "");
      for (auto &argument : arguments)
        std::getline(std::cin, argument);
      const pid_t pid = fork();
      if (pid == 0)
        return become(directory, out, err, program);
      std::printf("%d\n", pid);
      std::fflush(stdout);
      int    status = 0;
      rusage usage{};
      wait4(pid, &status, 0, &usage);
      std::printf("%d %.3f\n", status,
                  usage.ru_utime.tv_sec + usage.ru_stime.tv_sec + 1e-6 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec));
      std::fflush(stdout);
    }
    _exit(0);
  }
} // namespace

using Main = int (*)(int, char **, char **);

extern "C" int __libc_start_main(Main main, int argc, char **argv, void (*init)(), void (*fini)(), void (*end)(), void *stack)
{
  const auto original = reinterpret_cast<decltype(&__libc_start_main)>(dlsym(RTLD_NEXT, "__libc_start_main"));
  if (std::getenv("TALUS_FORK_SERVER") == nullptr)
    return original(main, argc, argv, init, fini, end, stack);
  unsetenv("LD_PRELOAD");
  serve(argv[0]);
  return original(main, pointers.size() - 1, pointers.data(), init, fini, end, stack);
}
