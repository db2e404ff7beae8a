#!/usr/bin/env bash
# Run a command as in a strict container: the file system is read-only but for /out, there is no
# HOME, the user is nobody, and all processes together have 512 MB. It needs root on Linux with
# cgroup v1. The first argument is the folder of an environment with Drapery:
#   benchmarks/container.sh ENV drapery render 'white creeper:lime' -o banner.png
set -euo pipefail
environment=$(cd "$1" && pwd)
shift
group=/sys/fs/cgroup/memory/drapery-$$
mkdir "$group"
trap 'cat "$group/memory.max_usage_in_bytes"; rmdir "$group"' EXIT
echo 512M >"$group/memory.limit_in_bytes"
unshare --mount bash -euo pipefail -s "$group" "$environment" "$@" <<'INSIDE'
group=$1 environment=$2
shift 2
base=$(mktemp -d)
mount -t tmpfs tmpfs "$base"
mkdir "$base/upper" "$base/work" "$base/root"
mount -t overlay overlay -o "lowerdir=/,upperdir=$base/upper,workdir=$base/work" "$base/root"
mkdir -p "$base/root/out"
chmod 711 "$base/root/root" # so that nobody may run a Python that lies below root's home
mount -o remount,ro "$base/root"
mount -t tmpfs -o mode=1777,size=64m tmpfs "$base/root/out"
mount -t proc proc "$base/root/proc"
mount --bind /dev "$base/root/dev"
echo $$ >"$group/cgroup.procs"
chroot --userspec=65534:65534 "$base/root" env -i PATH="$environment/bin:/usr/bin:/bin" \
  bash -c 'cd /out && "$@"' run "$@"
INSIDE
