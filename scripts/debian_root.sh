# Functions for scripts that work in a root of another Debian release; source it. Needs root and
# Debian's package debootstrap.

# suite_of RELEASE: prints the name of Debian 12 or 13.
suite_of() {
  case $1 in
    12) echo bookworm ;;
    13) echo trixie ;;
    *) return 1 ;;
  esac
}

# make_root RELEASE FOLDER: makes a minimal system.
make_root() {
  echo "making $2"
  rm -rf "$2.part"
  debootstrap --variant=minbase "$(suite_of "$1")" "$2.part" http://deb.debian.org/debian >"$2.log" || {
    tail -n 20 "$2.log" >&2
    return 1
  }
  mv "$2.part" "$2"
}

# enter_root FOLDER: mounts what programs need, until leave_root.
enter_root() {
  entered=$1
  mounted=()
  cp /etc/resolv.conf "$entered/etc/resolv.conf"
  for folder in proc sys dev; do
    mount --rbind --make-rslave "/$folder" "$entered/$folder"
    mounted+=("$folder")
  done
}

leave_root() {
  for folder in "${mounted[@]}"; do umount -l "$entered/$folder"; done
  mounted=()
}

# within COMMAND: runs a shell command in the root, in its folder $within_folder.
within() {
  chroot "$entered" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive sh -c "cd ${within_folder:-/} && $*"
}
