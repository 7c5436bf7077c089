# The commands of ./do that build for boards; sourced by it.

# board ARCHITECTURE: the compiler's Debian package, the emulator and the sysroot of a preset.
board() {
  case "$1" in
    aarch64) board_compiler=g++-aarch64-linux-gnu board_sysroot=arm64 ;;
    armhf) board_compiler=g++-arm-linux-gnueabihf board_sysroot=armhf ;;
    armv6) board_compiler=g++-arm-linux-gnueabi board_sysroot=armel ;;
    riscv64) board_compiler=g++-riscv64-linux-gnu board_sysroot=headers ;;
    *) fail "usage: ./do cross aarch64|armhf|armv6|riscv64 [build]" ;;
  esac
}

# cross_build PRESET [TARGET...]
cross_build() {
  local preset=$1
  shift
  step "configure-$preset" "configuring build/$preset" cmake --preset "$preset"
  step "build-$preset" "building ${*:-everything} in build/$preset" \
    cmake --build --preset "$preset" --parallel "$(nproc)" ${1:+--target "$@"}
}

# Whatever SIMD targets and vector lengths the emulator has must give the tracked checksums.
golden_by_sve_length() {
  cross_build aarch64-max golden_test
  local bytes
  for bytes in 16 32 64; do
    printf 'SVE registers of %d bytes:\n' $bytes
    qemu-aarch64 -cpu max,sve-default-vector-length=$bytes -L /usr/aarch64-linux-gnu \
      -E LD_LIBRARY_PATH=build/sysroot/arm64/usr/lib/aarch64-linux-gnu \
      build/aarch64-max/tests/golden_test --no-intro=true >"$LOGS/golden-$bytes.log" 2>&1 ||
      fail "checksums differ with SVE registers of $bytes bytes: see $LOGS/golden-$bytes.log"
    grep '^golden:' "$LOGS/golden-$bytes.log"
  done
}

# cross ARCHITECTURE [build]: builds everything for a board and runs every test on an emulated one.
cross() {
  local PACKAGES="cmake ninja-build pkg-config" preset=${1:-} board_compiler board_sysroot
  board "$preset"
  PACKAGES="$PACKAGES $board_compiler"
  [ "${2:-}" = build ] || PACKAGES="$PACKAGES qemu-user"
  install_missing
  step "sysroot-$preset" "fetching headers and libraries for $preset" \
    toolchains/sysroot.sh $board_sysroot build/sysroot/$board_sysroot
  cross_build "$preset"
  [ "${2:-}" = build ] && return
  ctest --preset "$preset" --parallel "$(nproc)" || exit 1
  [ "$preset" != aarch64 ] || golden_by_sve_length
}

# Records the checksums of tests/golden.txt anew, after an intended change of the engine's output.
golden() {
  install_missing
  build golden_test
  STARFOCUS_RECORD_GOLDEN=1 $BUILD/tests/golden_test --no-intro=true
}
