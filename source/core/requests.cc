#include <talus/core/requests.h>

#include <csignal>

namespace Talus
{
  namespace
  {
    // A handler reaches nothing else.
    volatile std::sig_atomic_t noted = 0;

    void note(const int signal) { noted = signal; }

    void handle(const int signal, void (*handler)(int), const int flags)
    {
      struct sigaction action
      {
      };
      action.sa_handler = handler;
      action.sa_flags   = flags;
      sigemptyset(&action.sa_mask);
      sigaction(signal, &action, nullptr);
    }
  } // namespace

  Requests::Signals::Signals()
  {
    noted = 0;
    handle(SIGTERM, note, SA_RESTART);
    handle(SIGUSR1, note, SA_RESTART);
    handle(SIGINT, note, static_cast<int>(SA_RESTART | SA_RESETHAND));
  }

  Requests::Signals::~Signals()
  {
    for (const int signal : {SIGTERM, SIGUSR1, SIGINT})
      handle(signal, SIG_DFL, 0);
  }

  bool Requests::is_signal_noted() { return noted != 0; }

  std::string Requests::signal_name() const
  {
    switch (static_cast<int>(signal))
    {
      case SIGTERM:
        return "SIGTERM";
      case SIGINT:
        return "SIGINT";
      case SIGUSR1:
        return "SIGUSR1";
      default:
        return "no signal";
    }
  }

  void Requests::add_to(Reduction &reduction)
  {
    signal = noted;
    reduction.max(signal);
    reduction.any(wants_checkpoint);
  }
} // namespace Talus
