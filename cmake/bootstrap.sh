# Sourced by ./run and ./test: brings this machine and the build folder up to date.
# What is there already costs a fraction of a second.

# Installs the Debian packages that are missing, and says which.
install_packages() {
  local wanted missing=()
  mapfile -t wanted < <(grep -v '^#' cmake/debian-packages.txt)
  local installed
  installed=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' "${wanted[@]}" 2>/dev/null || true)
  local package
  for package in "${wanted[@]}"; do
    grep -q "^$package installed$" <<<"$installed" || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "These Debian packages are missing, and there is no sudo to install them with:" >&2
      echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
      exit 3
    fi
    as_root=(sudo)
  fi
  echo "Installing Debian packages: ${missing[*]}" >&2
  "${as_root[@]}" apt-get update -qq >&2
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
}

# PCL's and ArUco's headers, into build/headers. Installing these packages would install a hundred
# times as much that nothing here uses: VTK, Java, MPI, Qt, and every other module of OpenCV.
unpack_headers() {
  local package
  for package in libpcl-dev libflann-dev libopencv-contrib-dev; do
    if [ -e "build/headers/$package" ] || [ -e "/usr/share/doc/$package" ]; then continue; fi
    echo "Unpacking the headers of $package" >&2
    (
      folder=$(mktemp -d)
      trap 'rm -r "$folder"' EXIT
      cd "$folder"
      apt-get download -qq -o APT::Sandbox::User=root "$package" >&2
      dpkg-deb --extract "$package"_*.deb unpacked
      mkdir -p "$OLDPWD/build/headers/usr"
      cp -r unpacked/usr/include "$OLDPWD/build/headers/usr"
      touch "$OLDPWD/build/headers/$package"
    )
  done
}

# build_preset PRESET [TARGET...]: configures once and builds; quiet unless there is something to do.
build_preset() {
  local preset=$1
  shift
  local folder=build/release
  if [ ! -f "$folder/build.ninja" ] || [ "$(cat "$folder/preset" 2>/dev/null)" != "$preset" ]; then
    echo "Configuring ($preset)" >&2
    mkdir -p "$folder"
    if ! cmake --preset "$preset" >"$folder/configure.log" 2>&1; then
      cat "$folder/configure.log" >&2
      exit 3
    fi
    echo "$preset" >"$folder/preset"
  fi
  if ! ninja -C "$folder" -n "$@" 2>/dev/null | grep -q 'no work to do'; then
    echo "Building (a few minutes the first time)" >&2
    ninja -C "$folder" "$@" >&2 || exit 3
  fi
}

# bring_up_to_date PRESET [TARGET...]: the packages and the build. One call at a time: others wait.
bring_up_to_date() {
  mkdir -p build
  (
    if ! flock --nonblock 9; then
      echo "Waiting for another call that is building" >&2
      flock 9
    fi
    install_packages
    unpack_headers
    build_preset "$@"
  ) 9>build/lock
}
