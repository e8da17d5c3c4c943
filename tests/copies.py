"""Many runs of talus on one rank: in copies of a program that has linked its 200 libraries once (fork_server.cc)."""
import atexit
import os
import select
import shutil
import signal
import subprocess
import tempfile
import time


class Copies:
    def __init__(self, talus, server=os.environ.get("TALUS_FORK_SERVER_LIBRARY", "")):
        """Without a server each run is a process of its own."""
        self.talus, self.process, self.directory = talus, None, tempfile.mkdtemp()
        self.seconds = 0  # of the processor, in copies
        atexit.register(shutil.rmtree, self.directory, True)
        # Each rank for itself, which needs no daemon, with its own place for what MPI keeps in files.
        self.environment = dict(os.environ, OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1", OMPI_MCA_pml="ob1",
                                OMPI_MCA_ess_singleton_isolated="1", OMPI_MCA_orte_tmpdir_base=self.directory)
        if server:
            before = self.environment.get("LD_PRELOAD")
            environment = dict(self.environment, LD_PRELOAD=(before + ":" if before else "") + server, TALUS_FORK_SERVER="1")
            self.process = subprocess.Popen([talus], env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                            bufsize=1)

    def run(self, arguments, directory=".", seconds=3600, by_clock=3600):
        """Exit status, negative for a signal, and None where it takes longer; stdout and stderr."""
        out, err = (os.path.join(self.directory, name) for name in ("stdout", "stderr"))
        if self.process is None:
            with open(out, "w") as to_out, open(err, "w") as to_err:
                process = subprocess.Popen([self.talus] + arguments, cwd=directory, env=self.environment, stdout=to_out,
                                           stderr=to_err, stdin=subprocess.DEVNULL)
                status = self.wait(process.pid, lambda: process.poll() is not None, seconds, by_clock)
                status = process.wait() if status else None
        else:
            lines = [os.path.abspath(directory), out, err, str(len(arguments))] + arguments
            self.process.stdin.write("".join(line.replace("\n", " ") + "\n" for line in lines))
            self.process.stdin.flush()
            pid = int(self.process.stdout.readline())
            is_over = self.wait(pid, lambda: select.select([self.process.stdout], [], [], 0.1)[0], seconds, by_clock)
            ended, spent = self.process.stdout.readline().split()
            ended = int(ended)
            self.seconds += float(spent)
            status = None if not is_over else -(ended & 127) if ended & 127 else ended >> 8
        texts = []
        for path in (out, err):
            with open(path, errors="replace") as file:
                texts.append(file.read())
        return (status, *texts)

    @staticmethod
    def wait(pid, is_over, seconds, by_clock):
        """Whether it ends in time; if not it is killed."""
        end = time.time() + by_clock
        while not is_over():
            if time.time() > end or processor_time(pid) > seconds:
                os.kill(pid, signal.SIGKILL)
                return False
            time.sleep(0.002)
        return True


def processor_time(pid):
    try:
        with open(f"/proc/{pid}/stat") as file:
            fields = file.read().rsplit(")", 1)[1].split()
    except (FileNotFoundError, ProcessLookupError):
        return 0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
