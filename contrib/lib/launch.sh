# Shared by the commands of contrib/: `source` it, then call prepare and run_python.
# The build directory is build, or what TALUS_BUILD says.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$(cd "$root" && realpath -m "${TALUS_BUILD:-build}")
export TALUS_BUILD=$build

# True when one of the arguments asks for help, which needs nothing to be installed or built.
wants_help() { case " $* " in *" --help "* | *" -h "*) true ;; *) false ;; esac; }

# Installs what is missing and builds the program; quick when there is nothing to do.
prepare() {
  "$root/contrib/install-dependencies"
  [ -f "$build/CMakeCache.txt" ] || cmake -S "$root" -B "$build" -G Ninja
  cmake --build "$build" --target talus -j "$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)"
}

# Runs a Python script of contrib/lib with an interpreter that has numpy and matplotlib. The first
# python3 of PATH may be one without them; Debian's packages belong to /usr/bin/python3.
run_python() {
  local python
  for python in python3 /usr/bin/python3; do
    if "$python" -c 'import numpy, matplotlib' 2> /dev/null; then
      exec "$python" -B "$root/contrib/lib/$1" "${@:2}"
    fi
  done
  echo "No python3 with numpy and matplotlib. Install python3-numpy and python3-matplotlib." >&2
  exit 1
}
