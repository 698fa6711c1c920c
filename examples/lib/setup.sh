# Shared by examples/hydraulic_jump/run.sh and tests/run.sh: installs the Debian packages that are missing, configures and
# builds. Source it from bash; every function ends the script with one clear sentence when something is wrong.

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$project/build/release
logs=$project/build/logs

build_packages=(g++ cmake ninja-build libeigen3-dev libhdf5-dev libyaml-cpp-dev libfmt-dev libcli11-dev zlib1g-dev liblzma-dev pybind11-dev)
picture_packages=(python3 python3-matplotlib python3-numpy python3-scipy python3-h5py python3-yaml)
test_packages=(libgtest-dev libgmock-dev libbenchmark-dev python3-jinja2 python3-pandas python3-pytest chromium valgrind)
# VTK checks the field files and is what courant::vtk is for. Its packages cannot stand beside the Python of ParaView, which has a VTK of its own.
dpkg-query -W -f='${db:Status-Status}' python3-paraview 2>/dev/null | grep -qx installed || test_packages+=(libvtk9-dev python3-vtk9)

say() { printf '%s\n' "$*"; }

stop() {  # message, then hints
  printf '\nStopped: %s\n' "$1" >&2
  shift
  for hint in "$@"; do printf '  %s\n' "$hint" >&2; done
  exit 1
}

free_megabytes() {  # of the file system that holds a folder, or the nearest parent that exists
  local folder=$1
  while [ ! -d "$folder" ]; do folder=$(dirname "$folder"); done
  df -Pm "$folder" | awk 'NR == 2 {print $4}'
}

need_space() {  # folder, megabytes, what for
  local free
  free=$(free_megabytes "$1")
  [ "${free:-0}" -ge "$2" ] || stop "the disk is too full: $3 needs $2 MB at $1, $free MB are free." "Make room and start again."
}

missing_packages() {  # those of the arguments that are not installed
  local package
  for package in "$@"; do
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || printf '%s\n' "$package"
  done
}

explain_apt_failure() {  # log file
  if grep -qiE 'no space left|not have enough free space' "$1"; then
    stop "the disk is full." "Make room (df -h shows where) and start again; details: $1"
  elif grep -qiE 'could not resolve|temporary failure|unable to connect|connection (timed out|refused|failed)|network is unreachable|failed to fetch' "$1"; then
    stop "the Debian package servers cannot be reached." "Check the network and /etc/apt/sources.list, then start again; details: $1"
  elif grep -qi 'unable to locate package' "$1"; then
    stop "$(grep -i -m1 'unable to locate package' "$1" | sed 's/^E: //')." "/etc/apt/sources.list should name Debian 12 (bookworm) main."
  elif grep -qiE 'could not get lock|unable to acquire' "$1"; then
    stop "another program is installing packages." "Wait for it to end and start again."
  fi
  stop "the packages could not be installed." "$(grep -m1 '^E: ' "$1" || tail -n 1 "$1")" "Details: $1"
}

install_packages() {  # package names
  local system=unknown version='' missing as_root=() log=$logs/packages.log
  if [ -r /etc/os-release ]; then
    system=$(. /etc/os-release && printf '%s' "${ID:-unknown}")
    version=$(. /etc/os-release && printf '%s' "${VERSION_ID:-}")
  fi
  if ! command -v dpkg-query >/dev/null; then
    say "This is $system $version, not Debian 12: assuming that g++, CMake, Ninja, Eigen, HDF5, yaml-cpp, fmt and CLI11 are there."
    return
  fi
  mapfile -t missing < <(missing_packages "$@")
  [ ${#missing[@]} -gt 0 ] || return 0
  [ "$system $version" = "debian 12" ] ||
    say "Note: this is $system $version; the package names are those of Debian 12."
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || stop "packages are missing, and installing them needs root." \
      "As root: apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo)
  fi
  need_space /usr 3000 "installing packages"
  need_space /var 1000 "fetching packages"
  mkdir -p "$logs"
  say "Installing ${#missing[@]} missing package(s) and what they need: ${missing[*]}"
  # apt-get update warns and goes on when servers are out of reach; the option makes it fail.
  "${as_root[@]}" apt-get -o DPkg::Lock::Timeout=300 -o APT::Update::Error-Mode=any update >"$log" 2>&1 ||
    explain_apt_failure "$log"
  # A cut connection is no reason to give up; apt goes on where it stopped.
  local attempt
  for attempt in 1 2 3; do
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3 \
      install -y --no-install-recommends "${missing[@]}" 2>&1 | tee -a "$log" | show_apt_progress && return 0
    grep -qi 'failed to fetch' "$log" || break
    [ "$attempt" = 3 ] || say "  fetching was cut off, trying again"
  done
  explain_apt_failure "$log"
}

show_apt_progress() {
  awk '/newly installed/ {n = $3; print "  " n " packages to install"; fflush()}
       /^Get:/ {if (++got % 50 == 0) {print "  " got " of " n " fetched"; fflush()}}
       /^Setting up/ {if (++set % 50 == 0) {print "  " set " of " n " set up"; fflush()}}'
}

parallel_jobs() {  # one per core, but each compiler needs about 900 MB
  local cores memory
  cores=$(nproc)
  memory=$(awk '/^MemAvailable/ {print int($2 / 900000)}' /proc/meminfo)
  [ "$memory" -ge 1 ] || memory=1
  printf '%s' $((cores < memory ? cores : memory))
}

other_instruction_sets() {  # those whose loops this machine does not run; the plain ones stay, so that the program runs anywhere
  if grep -qw avx512vl /proc/cpuinfo && grep -qw avx512dq /proc/cpuinfo; then
    printf 'avx2'
  elif grep -qw avx2 /proc/cpuinfo && grep -qw fma /proc/cpuinfo; then
    printf 'avx512'
  else
    printf 'avx2;avx512'
  fi
}

configure() {  # cmake options
  command -v cmake >/dev/null || stop "CMake is not there." "apt-get install cmake"
  command -v ninja >/dev/null || stop "Ninja is not there." "apt-get install ninja-build"
  command -v "${CXX:-c++}" >/dev/null || stop "there is no C++ compiler (${CXX:-c++})." "apt-get install g++"
  mkdir -p "$logs" 2>/dev/null && [ -w "$logs" ] || stop "the folder $project/build cannot be written to."
  [ -f "$build/build.ninja" ] && [ $# -eq 0 ] && return 0
  # A new build takes several files at once and reads common headers once: half the time.
  [ -f "$build/CMakeCache.txt" ] || set -- -DCMAKE_BUILD_TYPE=Release -DCOURANT_UNITY=ON -DCOURANT_PRECOMPILED_HEADERS=ON "$@"
  say "Configuring in ${build#"$project"/}"
  cmake -S "$project" -B "$build" -G Ninja "$@" >"$logs/configure.log" 2>&1 ||
    stop "CMake could not configure the build." "$(grep -m1 -A3 'CMake Error' "$logs/configure.log" | tr '\n' ' ')" \
      "Details: $logs/configure.log"
}

build_targets() {  # ninja targets
  [ -x "$build/courant" ] || need_space "$build" 400 "building"
  say "Building"
  if NINJA_STATUS='  [%f/%t] ' ninja -C "$build" -j "$(parallel_jobs)" "$@" 2>&1 | tee "$logs/build.log" |
    grep --line-buffered -vE '^ninja: (Entering|no work)|Re-checking globbed'; [ "${PIPESTATUS[0]}" -ne 0 ]; then
    grep -qi 'no space left' "$logs/build.log" && stop "the disk is full." "Make room and start again."
    grep -qiE 'Killed signal|out of memory|cannot allocate' "$logs/build.log" &&
      stop "the compiler ran out of memory." "Close other programs and start again."
    if grep -qs '^COURANT_UNITY:BOOL=ON' "$build/CMakeCache.txt"; then  # two files of a folder may give a name different meanings
      say "Once more, file by file"
      configure -DCOURANT_UNITY=OFF -DCOURANT_PRECOMPILED_HEADERS=OFF
      build_targets "$@"
      return
    fi
    stop "the build failed; the compiler's messages are above." "They are also in $logs/build.log"
  fi
}

run_paper() {  # Python script, megabytes of its results, its arguments: builds what it needs and becomes it
  local script=$1 space=$2 python=/usr/bin/python3 word  # Debian's, which has yaml; another one in PATH may not
  shift 2
  [ -x "$python" ] || python=python3
  for word in "$@"; do
    case $word in
      -h | --help) sed -n '3,/^"""$/p' "$script" | sed '$d'; exit 0 ;;
    esac
  done
  install_packages "${build_packages[@]}" "${picture_packages[@]}" python3-yaml
  (cd "$project" || exit 1
    options=()
    [ -f "$build/CMakeCache.txt" ] || options=(-DCOURANT_TESTS=OFF)
    configure "${options[@]}"
    build_targets courant) || exit 1
  need_space "$project" "$space" "the results of all runs"
  exec "$python" "$script" --courant "$build/courant" "$@"
}
