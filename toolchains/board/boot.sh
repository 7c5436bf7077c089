#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# boot.sh STARFOCUS BOARD_REFOCUS FOLDER: boots Debian's arm64 kernel on QEMU's "virt" board. The
# board runs BOARD_REFOCUS, the statically linked program of an aarch64 build. STARFOCUS is the
# program starfocus for the host, which makes the small light field for the board. QEMU's power
# button presses the shutter on line 3 of the board's PL061 GPIO chip. The picture that the board
# writes to a file and to the screen must equal the picture that STARFOCUS computes on the host. The
# busy signal, which the board sets on line 5, must read back as set. The downloaded kernel stays in
# FOLDER for later runs.
set -u
[ $# = 3 ] || { echo "usage: $0 STARFOCUS BOARD_REFOCUS FOLDER" >&2; exit 2; }
starfocus=$(realpath "$1") program=$(realpath "$2") folder=$(realpath -m "$3")
here=$(realpath "$(dirname "$0")")
fetch=$here/../fetch.sh
width=160 height=120 # size of the light field
seconds=${STARFOCUS_BOOT_SECONDS:-120}
emulator=

fail() {
  echo "board boot: $*" >&2
  tail -qn 40 "$run"/qemu.log "$run"/serial.log >&2
  exit 1
}

mkdir -p "$folder"
run=$(mktemp -d) || exit 1
finish() {
  [ -z "$emulator" ] || kill "$emulator" 2>/dev/null
  rm -rf "$run"
}
trap finish EXIT

"$fetch" arm64 "$folder/kernel" 'linux-image-[0-9].*-arm64' linux-image-arm64 >"$folder/fetch.log" 2>&1 &&
  "$fetch" arm64 "$folder/busybox" - busybox-static >>"$folder/fetch.log" 2>&1 ||
  fail "Debian's kernel could not be fetched: see $folder/fetch.log"
kernel=$(ls "$folder"/kernel/boot/vmlinuz-* | head -n 1)

# needed_modules NAME: prints the files of a kernel module and its dependencies, dependencies first.
needed_modules() {
  local file dependency
  file=$(find "$folder/kernel/lib/modules" -name "$1.ko" -o -name "${1//_/-}.ko" | head -n 1)
  [ -n "$file" ] || return 1
  for dependency in $(tr '\0' '\n' <"$file" | sed -n 's/^depends=//p' | tr ',' ' '); do
    needed_modules "$dependency" || return 1
  done
  echo "$file"
}

# The screen requires kernel modules that later kernel packages may name or divide differently. If a
# module is missing, the screen is not tested.
make_initramfs() {
  local root=$run/root module
  mkdir -p "$root/bin" "$root/dev" "$root/proc" "$root/sys" "$root/tmp" "$root/etc" "$root/modules"
  chmod 1777 "$root/tmp" && chmod 755 "$root"
  cp "$here/init.sh" "$root/init"
  cp "$program" "$root/bin/board_refocus"
  cp "$(find "$folder/busybox" -path "*/bin/busybox" -type f)" "$root/bin/busybox"
  for name in sh mount insmod cat wc grep sed sha256sum sleep poweroff su mkdir; do
    ln -s busybox "$root/bin/$name"
  done
  printf 'root:x:0:0::/:/bin/sh\nnobody:x:65534:65534::/:/bin/sh\n' >"$root/etc/passwd"
  cp -r "$run/field" "$root/field"
  echo "$focus" >"$root/focus"
  chmod -R a+rX "$root" && chmod a+x "$root/init" "$root/bin/busybox" "$root/bin/board_refocus"
  : >"$root/modules/order"
  needed_modules bochs | awk '!seen[$0]++' | while read -r module; do
    cp "$module" "$root/modules/"
    basename "$module" >>"$root/modules/order"
  done
  (cd "$root" && find . | cpio -o -H newc --quiet | gzip -1) >"$run/initramfs"
}

# await TEXT: waits until the board has printed TEXT.
await() {
  while ! grep -q "^board: $1" "$run/serial.log"; do
    kill -0 "$emulator" 2>/dev/null || fail "the board stopped before saying '$1'"
    [ $SECONDS -lt "$seconds" ] || fail "the board did not say '$1' in $seconds seconds"
    sleep 0.05
  done
}

say() {
  echo "$1" >"$run/monitor.in"
}

# expect WHAT PATTERN: fails unless the board has printed a line that matches PATTERN.
expect() {
  tr -d '\r' <"$run/serial.log" | grep -Eq "^board: $2\$" || fail "expected $1: 'board: $2'"
}

"$starfocus-lab" scene "$run/field" --name portrait --size ${width}x$height --views 5 >/dev/null ||
  fail "no light field"
focus=$(sed -n 's/^near: .*disparity //p' "$run/field/meta.txt")
"$starfocus" refocus "$run/field" -o "$run/expected.ppm" --focus "$focus" --mode frame --renderer slices >/dev/null ||
  fail "no picture to compare with"
make_initramfs

mkfifo "$run/monitor.in" "$run/monitor.out"
: >"$run/serial.log"
SECONDS=0
qemu-system-aarch64 -M virt -cpu cortex-a53 -m 256 -display none -nodefaults -no-reboot \
  -device bochs-display,romfile= -serial "file:$run/serial.log" -monitor "pipe:$run/monitor" \
  -kernel "$kernel" -initrd "$run/initramfs" -append 'console=ttyAMA0 quiet panic=-1' \
  >"$run/qemu.log" 2>&1 &
emulator=$!
cat "$run/monitor.out" >/dev/null &
await 'press file'
say system_powerdown
await 'ended-file'
if await '\(press screen\|no-screen\)' && grep -q '^board: press screen' "$run/serial.log"; then
  say system_powerdown
  await 'shown'
  sleep 1
  say "screendump $run/screen.ppm"
fi
await 'done'
wait $emulator
emulator=
elapsed=$SECONDS

sum=$(sha256sum <"$run/expected.ppm" | cut -d ' ' -f 1)
expect "the list of chips" 'chips gpiochip0: .*, 8 lines'
expect "one line about a missing chip" 'refused-chip 1 1 board_refocus: /dev/gpiochip7: expected .*'
expect "one line about a missing line" 'refused-line 1 1 board_refocus: /dev/gpiochip0: expected .*'
expect "one line about permission" 'refused-permission 1 1 board_refocus: .*permission.*'
expect "one line about a busy line" 'refused-busy 1 1 board_refocus: .*another program holds.*'
expect "the program's good end" 'ended-file 0'
expect "the busy line's levels" 'log picture 1: .*, busy line read back 1, then 0'
expect "the checksum of this machine's picture" "sum $sum  /tmp/picture-1.ppm"

# The middle of the board's screen must show the refocused picture.
if [ -s "$run/screen.ppm" ]; then
  expect "the program's good end" 'ended-screen 0'
  read -r across down < <(sed -n 2p "$run/screen.ppm")
  left=$(((across - width) / 2)) top=$(((down - height) / 2))
  tail -c $((across * down * 3)) "$run/screen.ppm" >"$run/pixels"
  for ((y = top; y < top + height; ++y)); do
    tail -c +$(((y * across + left) * 3 + 1)) "$run/pixels" | head -c $((width * 3))
  done >"$run/shown"
  tail -c $((width * height * 3)) "$run/expected.ppm" | cmp - "$run/shown" ||
    fail "the framebuffer shows another picture"
  screen="on a screen of ${across}x$down too"
else
  screen="no screen"
fi
tr -d '\r' <"$run/serial.log" | sed -n 's/^board: \(log \(ready\|picture\)\)/\1/p'
echo "board boot: the picture has this machine's checksum ($sum), $screen; $elapsed s"
