#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# First process of the board that boot.sh emulates. The script runs board_refocus and prints each
# result on the serial line as "board: NAME VALUE".
PATH=/bin
mount -t devtmpfs none /dev
mount -t proc none /proc
mount -t sysfs none /sys
for module in $(cat /modules/order); do
  insmod "/modules/$module"
done

tell() {
  echo "board: $*"
}

# refused NAME COMMAND...: the command must exit with 1 and print one line of explanation.
refused() {
  local name=$1
  shift
  "$@" >/tmp/out 2>/tmp/err
  tell "refused-$name" $? "$(wc -l </tmp/err)" "$(cat /tmp/err)"
}

camera() {
  board_refocus /field --chip gpiochip0 --shutter 3 --active high --bias none --mode frame \
    --pictures 1 "$@"
}

# pressed NAME OPTIONS...: starts the camera, requests the button and prints the camera's output.
pressed() {
  local name=$1
  shift
  camera "$@" >/tmp/log 2>&1 &
  until grep -q '^ready' /tmp/log; do
    kill -0 $! || break
  done
  [ "$name" != file ] || refused busy camera --out /tmp/other.ppm
  tell press "$name"
  wait $!
  tell "ended-$name" $?
  sed 's/^/board: log /' /tmp/log
}

mkdir -p /tmp
tell chips "$(board_refocus --list)"
refused chip board_refocus /field --chip gpiochip7 --shutter 3 --out /tmp/picture.ppm
refused line board_refocus /field --shutter 300 --out /tmp/picture.ppm
refused permission su -s /bin/sh nobody -c \
  'board_refocus /field --shutter 3 --out /tmp/picture.ppm'
pressed file --busy 5 --out /tmp/picture.ppm --focus "$(cat /focus)"
tell sum "$(sha256sum /tmp/picture-1.ppm)"
if [ -e /dev/fb0 ]; then
  pressed screen --framebuffer /dev/fb0 --focus "$(cat /focus)"
  tell shown
  sleep 3
else
  tell no-screen
fi
tell done
poweroff -f
