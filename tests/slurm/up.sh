#!/usr/bin/env bash
# Brings up Slurm on this machine alone: munged, slurmctld and slurmd without systemd, as root.
# Usage: up.sh FOLDER, which gets the state, the logs and the process ids that down.sh ends.
set -euo pipefail
folder=$1
conf=/etc/slurm/slurm.conf # jobs look for it there, whatever SLURM_CONF says
host=$(hostname -s)
mkdir -p "$folder/state" "$folder/spool"

if [ -e "$conf" ]; then
    echo "slurm: this machine has a Slurm of its own, which is left alone" >&2
    exit 1
fi
touch "$folder/started" # from here on down.sh has something to end

[ -s /etc/munge/munge.key ] || mungekey --create
install -d -o munge -g munge -m 755 /run/munge
if ! munge --no-input 2> /dev/null | unmunge > /dev/null 2>&1; then
    runuser -u munge -- munged --pid-file=/run/munge/munged.pid
    echo /run/munge/munged.pid >> "$folder/pidfiles"
fi

# No accounting database: the executor then asks squeue, so that ended jobs must stay known.
cat > "$conf" << EOF
# Of a gate of kacsim, which removes it.
ClusterName=gate
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=batch_sched_delay=0,sched_min_interval=100000,sched_interval=2
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MinJobAge=3600
ReturnToService=2
KillWait=5
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=3000 State=UNKNOWN
PartitionName=main Nodes=$host Default=YES MaxTime=INFINITE State=UP
EOF
printf '%s\n' "$folder/slurmctld.pid" "$folder/slurmd.pid" >> "$folder/pidfiles"
slurmctld
slurmd -N "$host"
for _ in $(seq 100); do
    [ "$(sinfo --noheader --format=%T 2> /dev/null)" = idle ] && exit 0
    sleep 0.2
done
echo "slurm: the node is not idle after 20 s; the logs:" >&2
tail -n 5 "$folder"/*.log >&2
exit 1
