#!/usr/bin/env bash
# Installs the Debian package on a bare Debian 12 and uses it as a user would: program, Python, manual pages, a scene, a deck. By hand,
# as root in a fresh system (a container or a chroot), not in each run of the tests. The last line counts.
#
# usage: tests/packages.sh FOLDER_OF_PACKAGES   (that of cmake/packages.py)
set -uo pipefail
folder=${1:?usage: tests/packages.sh FOLDER_OF_PACKAGES}
package=$(find "$folder" -name 'courant_*.deb' | sort | tail -n 1)
[ -n "$package" ] || { echo "there is no courant_*.deb in $folder: python3 cmake/packages.py deb makes one"; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
passed=0 failed=0

check() {  # what, command...
  local what=$1
  shift
  if (cd "$work" && "$@") >"$work/log" 2>&1; then
    passed=$((passed + 1))
    echo "passed   $what"
  else
    failed=$((failed + 1))
    echo "FAILED   $what"
    tail -n 20 "$work/log"
  fi
}

cp "$package" "$work/courant.deb"
chmod 644 "$work/courant.deb" && chmod 755 "$work"
export DEBIAN_FRONTEND=noninteractive
check "apt-get update" apt-get update -qq
check "the package installs" apt-get install -y -qq --no-install-recommends "$work/courant.deb"
check "courant --version names the build" sh -c 'courant --version | grep -q "build"'
check "manual pages" sh -c 'zcat /usr/share/man/man1/courant-run.1.gz | grep -q "courant"'
check "completion" test -f /usr/share/bash-completion/completions/courant
cat >"$work/scene.yaml" <<'SCENE'
water: {spacing: 0.05, blocks: [{low: [0, 0], high: [0.5, 0.5]}]}
box: {low: [0, 0], high: [1.5, 1]}
end: 0.1
SCENE
check "a scene is checked" courant check scene.yaml
check "a scene runs" courant run scene.yaml -o water --threads 1
check "its verdict" grep -q "verdict: sound" water/summary.yaml
check "a ready deck is checked" courant check /usr/share/courant/keyword_decks/hydraulic_jump/d4_5s.k
check "a ready deck runs" courant run /usr/share/courant/keyword_decks/hydraulic_jump/d4_5s.k -o jump --until 0.02 --threads 1
check "Python opens results" python3 -c 'import courant; print(courant.open("jump").energies["kinetic"][-1])'
check "Python runs in its process" python3 -c '
import courant
from courant.native import native
assert native() is not None
scene = courant.Scene("box", spacing=0.05, end=0.02).water(low=(0, 0), high=(0.5, 0.5)).box(low=(0, 0), high=(1.5, 1), open=["top"])
assert scene.run("out", threads=1, quiet=True).verdict == "sound"'
check "pictures need matplotlib" apt-get install -y -qq --no-install-recommends python3-matplotlib python3-scipy
check "a picture of a run" courant post --view speed water
check "the package is removed" apt-get purge -y -qq courant
check "nothing is left of it" sh -c '! test -e /usr/lib/python3/dist-packages/courant && ! command -v courant'
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
