#!/usr/bin/env bash
# check_cluster.sh PROGRAM SOURCE: a sweep by a private Slurm of two nodes on this machine, and by GNU parallel, gives the
# bytes of one program; a part that is killed is made up for. Ends with 77, skipped, where they are not installed.
set -euo pipefail
export REPRISE="$1"  # for the scripts
source="$2"
for command in slurmctld slurmd sbatch munged parallel; do
  command -v "$command" >/dev/null || { echo "cluster: $command is not installed, nothing is tested."; exit 77; }
done
[[ $EUID -eq 0 ]] || { echo "cluster: Slurm's nodes need root, nothing is tested."; exit 77; }
folder="$(mktemp -d)"
chmod 755 "$folder"
cd "$folder"
pids=()
stop() {
  scancel --user root 2>/dev/null || true
  [[ ${#pids[@]} -eq 0 ]] || kill "${pids[@]}" 2>/dev/null || true
  wait 2>/dev/null || true
  rm -rf "$folder"
}
trap stop EXIT
fail() { echo "cluster: $*" >&2; tail -n 20 "$folder"/*.log "$folder"/sweep/log/* 2>/dev/null >&2 || true; exit 1; }

# Ports that nobody listens on.
read -r -a ports < <(/usr/bin/python3 -c '
import socket
sockets = [socket.socket() for _ in range(3)]
for one in sockets: one.bind(("127.0.0.1", 0))
print(*(one.getsockname()[1] for one in sockets))')
mkdir spool state one two
dd if=/dev/urandom of=munge.key bs=128 count=1 status=none
chmod 400 munge.key
munged --force --foreground --socket "$folder/munge.socket" --key-file "$folder/munge.key" --pid-file "$folder/munge.pid" \
  --log-file "$folder/munge.log" --seed-file "$folder/munge.seed" 2>munged.log &
pids+=($!)
cat >slurm.conf <<CONF
ClusterName=test
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort=${ports[0]}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CryptoType=crypto/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd-%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd-%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,batch_sched_delay=0
ReturnToService=2
MpiDefault=none
NodeName=one NodeHostname=localhost NodeAddr=127.0.0.1 Port=${ports[1]} CPUs=1
NodeName=two NodeHostname=localhost NodeAddr=127.0.0.1 Port=${ports[2]} CPUs=1
PartitionName=all Nodes=one,two Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF="$folder/slurm.conf"
for _ in {1..50}; do [[ -S munge.socket ]] && break; sleep 0.1; done
slurmctld -D >slurmctld.out.log 2>&1 &
pids+=($!)
for node in one two; do
  slurmd -D -N "$node" >"slurmd-$node.out.log" 2>&1 &
  pids+=($!)
done
for _ in {1..100}; do
  [[ "$(sinfo --noheader --format '%D %t' 2>/dev/null)" == "2 idle" ]] && break
  sleep 0.2
done
[[ "$(sinfo --noheader --format '%D %t')" == "2 idle" ]] || fail "the nodes do not come up: $(sinfo)"

cp "$source"/examples/{M1,P2}.toml .
cat >study.toml <<'TOML'
[sweep]
problem = "P2.toml"
compute = "synthesize"
[[vary]]
key = "workspace.semi_axes[0]"
from = 1.7
to = 1.75
count = 8
[[vary]]
key = "workspace.centre[1]"
from = 1.4
to = 1.6
count = 16
TOML
"$REPRISE" sweep study.toml --out alone >/dev/null

# Eight parts, of which one is killed in the midst of its work, once.
cat >reprise <<'WRAPPER'
#!/usr/bin/env bash
if [[ "$*" == *"--part 8/8" && ! -e killed ]]; then
  touch killed
  "$PROGRAM" "$@" &
  sleep 0.2
  kill -9 $! $$
fi
exec "$PROGRAM" "$@"
WRAPPER
chmod +x reprise
PROGRAM="$REPRISE" REPRISE="$folder/reprise" "$source/scripts/sweep-slurm" "$folder/study.toml" "$folder/sweep" 8 >/dev/null
for _ in {1..600}; do
  [[ -z "$(squeue --noheader)" ]] && break
  sleep 0.2
done
[[ -z "$(squeue --noheader)" ]] || fail "the jobs do not end: $(squeue)"
[[ -e sweep/sweep.csv ]] || fail "the parts were not put together"
[[ -e killed && $(ls sweep/log/merge-* | wc -l) -eq 2 ]] || fail "the part that was killed was not submitted again"
diff -r --exclude log alone sweep || fail "Slurm gives other bytes"

"$source/scripts/sweep-parallel" study.toml parallel 8 >/dev/null 2>parallel.log || fail "GNU parallel fails"
diff -r alone parallel || fail "GNU parallel gives other bytes"
