#!/usr/bin/env bash
# Ends what up.sh started in a folder, and nothing else. Usage: down.sh FOLDER
folder=$1
[ -e "$folder/started" ] || exit 0
timeout 10 scancel --user="$(id -un)"
for _ in $(seq 50); do
    [ -z "$(timeout 5 squeue --noheader)" ] && break
    sleep 0.2
done
tac "$folder/pidfiles" | while read -r file; do
    [ -s "$file" ] && kill "$(cat "$file")"
done
rm -f /etc/slurm/slurm.conf "$folder/started"
