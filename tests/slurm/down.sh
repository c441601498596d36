#!/usr/bin/env bash
# Ends what up.sh started in a folder, and nothing else. Usage: down.sh FOLDER
# down.sh --stale removes the configuration that a killed gate has left, without a controller: each
# start of Snakemake would wait 9 s for it.
conf=/etc/slurm/slurm.conf
if [ "$1" = --stale ]; then
    if grep -qs '^# Of a gate of kacsim' "$conf" && ! pgrep -x slurmctld > /dev/null; then
        rm -f "$conf"
    fi
    exit 0
fi
folder=$1
[ -e "$folder/started" ] || exit 0
timeout 10 scancel --user="$(id -un)"
for _ in $(seq 50); do
    [ -z "$(timeout 5 squeue --noheader)" ] && break
    sleep 0.2
done
pids=()
while read -r file; do
    [ -s "$file" ] && pids+=("$(cat "$file")")
done < <(tac "$folder/pidfiles")
kill "${pids[@]}" 2> /dev/null
# A controller saves its state before it ends: the folder is the caller's only then.
for _ in $(seq 100); do
    kill -0 "${pids[@]}" 2> /dev/null || break
    sleep 0.2
done
kill -KILL "${pids[@]}" 2> /dev/null
rm -f "$conf" "$folder/started"
