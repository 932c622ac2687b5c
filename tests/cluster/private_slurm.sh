# shellcheck shell=bash
# A Slurm cluster of this machine alone, for a test: munged, slurmctld and slurmd with keys, ports, state and logs of their own below
# a folder, started as whoever runs the test. Nothing of an installed cluster is read or written. Sourced, never run.

# Where something is missing, or does not start, this is the end: a test that cannot run has failed.
give_up() {
  echo "cannot test with Slurm: $*" >&2
  exit 1
}

daemons=()

# A port that nothing listens on.
free_port() {
  local port hex
  while :; do
    port=$((20000 + RANDOM % 30000))
    printf -v hex '%04X' "$port"
    if ! awk '{ print $2 }' /proc/net/tcp /proc/net/tcp6 2>/dev/null | grep -q ":$hex$"; then
      echo "$port"
      return
    fi
  done
}

# wait_until SECONDS COMMAND...
wait_until() {
  local end=$((SECONDS + $1))
  shift
  until "$@" >/dev/null 2>&1; do
    if (( SECONDS >= end )); then return 1; fi
    sleep 0.1
  done
}

show_logs() { tail -n 20 "$cluster"/*.log >&2 || true; }

# start_slurm FOLDER PROCESSORS: exports SLURM_CONF, so that sbatch and the others speak to this cluster.
start_slurm() {
  cluster="$1"
  local processors="$2" tool missing=()
  for tool in munged slurmctld slurmd sbatch squeue scontrol sinfo scancel; do
    if ! PATH="$PATH:/usr/sbin:/sbin" type -P "$tool" >/dev/null; then missing+=("$tool"); fi
  done
  if (( ${#missing[@]} > 0 )); then give_up "there is no ${missing[*]}; scripts/install_dependencies --tests installs them"; fi
  PATH="$PATH:/usr/sbin:/sbin"
  mkdir -p "$cluster"/{munge,state,spool}
  chmod 755 "$cluster" "$cluster"/munge
  (umask 077 && head -c 1024 /dev/urandom >"$cluster/munge/key")
  local user name
  user="$(id -un)"
  name="$(hostname -s)"
  cat >"$cluster/slurm.conf" <<CONF
ClusterName=private
SlurmctldHost=$name(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$cluster/munge/socket,cred_expire=5
CryptoType=crypto/munge
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd.pid
SlurmctldLogFile=$cluster/slurmctld.log
SlurmdLogFile=$cluster/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1,sched_min_interval=100000,batch_sched_delay=0,requeue_setup_env_fail
MpiDefault=none
KillWait=3
ReturnToService=2
NodeName=$name NodeAddr=127.0.0.1 CPUs=$processors RealMemory=$(awk "/^MemTotal:/ { print int(\$2 / 1024) }" /proc/meminfo) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF="$cluster/slurm.conf"
  munged --foreground --force --socket="$cluster/munge/socket" --key-file="$cluster/munge/key" --pid-file="$cluster/munge/pid" \
    --log-file="$cluster/munge/munged.log" --seed-file="$cluster/munge/seed" >"$cluster/munged.log" 2>&1 &
  daemons=($!)
  wait_until 20 test -S "$cluster/munge/socket" || { show_logs; give_up "munged does not start"; }
  slurmctld -D -c >"$cluster/slurmctld.out.log" 2>&1 &
  daemons+=($!)
  wait_until 20 scontrol ping || { show_logs; give_up "slurmctld does not start"; }
  slurmd -D -N "$name" >"$cluster/slurmd.out.log" 2>&1 &
  daemons+=($!)
  wait_until 30 node_is_idle || { show_logs; sinfo >&2; give_up "slurmd does not join"; }
}

node_is_idle() { [[ "$(sinfo -h -o %T)" == idle ]]; }

no_jobs() { [[ -z "$(squeue -h)" ]]; }

# Slurmd first, so that the others are there for what it still has to report. What is left after that (a slurmstepd belongs to nobody)
# is known by the folder in its environment, which no other process has.
stop_slurm() {
  local daemon process
  if (( ${#daemons[@]} == 0 )); then return; fi
  scancel --user="$(id -un)" >/dev/null 2>&1 || true
  wait_until 10 no_jobs || true
  for ((daemon = ${#daemons[@]} - 1; daemon >= 0; --daemon)); do
    kill "${daemons[daemon]}" 2>/dev/null || true
    wait_until 5 gone "${daemons[daemon]}" || kill -KILL "${daemons[daemon]}" 2>/dev/null || true
  done
  for process in /proc/[0-9]*; do
    if [[ "${process#/proc/}" != "$$" && "${process#/proc/}" != "$BASHPID" ]] && { tr '\0' '\n' <"$process/environ"; } 2>/dev/null |
      grep -qxF "SLURM_CONF=$cluster/slurm.conf"; then
      kill -KILL "${process#/proc/}" 2>/dev/null || true
    fi
  done
  daemons=()
}

gone() { ! kill -0 "$1" || [[ "$(awk '/^State:/ { print $2 }' "/proc/$1/status")" == Z ]]; }
