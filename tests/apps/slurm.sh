#!/bin/bash
# The job array of `dda sweep --slurm` on one node of Debian's slurm-wlm, set up in a directory of its own for this test:
#   slurm.sh DDA SCENE
# Exit status 77 (skipped) where Slurm is not installed, or cannot run jobs because we are not root.
set -eu
dda=$1 scene=$2
for program in slurmctld slurmd sbatch; do
  PATH=$PATH:/usr/sbin command -v $program >/dev/null || { echo "skipped: no $program (install slurm-wlm)"; exit 77; }
done
[ "$(id -u)" -eq 0 ] || { echo "skipped: slurmd runs jobs as root alone"; exit 77; }
export PATH=$PATH:/usr/sbin
work=$(mktemp -d)
export SLURM_CONF=$work/slurm.conf
started=()
stop() {
  for id in "${started[@]}"; do kill "$id" 2>/dev/null || true; done
  wait
  rm -rf "$work"
}
trap stop EXIT
mkdir "$work/state" "$work/spool" "$work/bin"
ln -s "$dda" "$work/bin/dda"
export PATH=$work/bin:$PATH
port=$((20000 + RANDOM % 10000))
cat > "$SLURM_CONF" <<CONF
ClusterName=test
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/none
CredType=cred/none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldParameters=idle_on_node_suspend
NodeName=$(hostname) NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
slurmctld -D > "$work/slurmctld.log" 2>&1 &
started+=($!)
slurmd -D > "$work/slurmd.log" 2>&1 &
started+=($!)

call=("$dda" sweep "$scene" --vary joint.0.friction_angle=0,15,30,95 --set analysis.steps=5 -o "$work/result")
"${call[@]}" --slurm
for ((attempt = 0; attempt < 60; ++attempt)); do
  sinfo --noheader --format=%t 2>/dev/null | grep -q idle && break
  sleep 0.5
done
(cd "$work" && timeout 120 sbatch --wait "$work/result/sweep.sbatch") || {
  tail -n 20 "$work"/*.log
  exit 1
}
# All cases but the impossible one are there; the call after the jobs tries that one again and writes the table.
for k in 1 2 3; do grep -q '"status": "completed"' "$work/result/case-$k/summary.json"; done
"${call[@]}" 2>&1 | tee "$work/last"
grep -q '1 of 4 cases to run' "$work/last"
[ "$(grep -c ',completed,' "$work/result/sweep.csv")" -eq 3 ]
grep -q ',failed,.*out of range' "$work/result/sweep.csv"
