#!/bin/sh
# A campaign as a job array of a real Slurm, one task of which is killed and requeued: the results are those of one
# process. Slurm runs here alone, with ports, keys and folders of its own, and without systemd.
# on_slurm.sh PROGRAM; exit status 77 where Debian's slurmctld, slurmd, slurm-client and munge are missing
set -eu
program=$(realpath "$1")
for needed in slurmctld slurmd sbatch munged; do
  PATH=$PATH:/usr/sbin command -v "$needed" >/dev/null || { echo "skipped: no $needed on this machine"; exit 77; }
done
[ "$(id -u)" = 0 ] || { echo "skipped: slurmd has to be started by root"; exit 77; }
PATH=$PATH:/usr/sbin
work=$(mktemp -d)
host=$(hostname -s)
end() {
  for daemon in slurmd slurmctld munged; do
    [ ! -s "$work/$daemon.pid" ] || kill "$(cat "$work/$daemon.pid")" 2>/dev/null || true
  done
  sleep 1
  rm -rf "$work"
}
trap end EXIT

# Ports that nobody else is likely to have.
port=$((20000 + $$ % 20000))
mkdir "$work/state" "$work/spool"
chmod 755 "$work"
dd if=/dev/urandom of="$work/munge.key" bs=128 count=1 2>/dev/null
chmod 400 "$work/munge.key"
cat >"$work/slurm.conf" <<END
ClusterName=rollrig_test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$work/munge.socket
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=batch_sched_delay=0,sched_interval=1
MailProg=/bin/true
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=main Nodes=$host Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF="$work/slurm.conf"
munged --force --key-file="$work/munge.key" --socket="$work/munge.socket" --pid-file="$work/munged.pid" \
  --log-file="$work/munged.log" --seed-file="$work/munged.seed" 2>/dev/null
slurmctld
slurmd

# Waits until a command prints something; at most a minute.
wait_for() {
  for _ in $(seq 1 300); do
    [ -z "$(eval "$1" 2>/dev/null)" ] || return 0
    sleep 0.2
  done
  echo "not within a minute: $1"
  squeue -t all
  tail -n 5 "$work"/*.log
  exit 1
}
wait_for 'sinfo -h -t idle'

cd "$work"
runs="iso_28580 --tire a50 --vary ambient_degC=20:30:0.05 --vary pressure_kPa=210,250"
# shellcheck disable=SC2086  # words
"$program" campaign new alone $runs --quiet
"$program" campaign run alone --quiet
"$program" campaign export alone --csv alone.csv --quiet
# shellcheck disable=SC2086
"$program" campaign new array $runs --quiet
"$program" campaign slurm array --tasks 10 >job.sh
job=$(sbatch --parsable --output="$work/task_%a.log" job.sh)
wait_for "ls array/results_0001_of_0010.sqlite.progress"
kill -9 "$(pgrep -f "campaign run '?$work/array" | head -1)"
echo "killed one task of job $job"
wait_for "squeue -h -j $job -t all -o '%K %T' | grep -E 'FAILED|COMPLETED'"
for task in $(squeue -h -j "$job" -t FAILED -o '%A'); do
  scontrol requeue "$task"
  scontrol update "JobId=$task" StartTime=now  # else Slurm waits for two minutes
done
wait_for "[ -n \"\$(squeue -h -j $job)\" ] || echo done"
"$program" campaign status array
"$program" campaign merge array --quiet
"$program" campaign export array --csv array.csv --quiet
cmp alone.csv array.csv
echo "the same results in 10 tasks as in one process: $(($(wc -l <array.csv) - 1)) items"
