# shellcheck shell=bash
# Completion of the whisker command. Made by scripts/manual.
_whisker() {
  local path=whisker word here=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} options="" words="" paths=none
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case "$path $word" in
      "whisker run" | "whisker world" | "whisker robot" | "whisker robot check" | "whisker robot layout" | "whisker robot calibrate" | "whisker robot calibrate-drive" | "whisker campaign" | "whisker scanner" | "whisker movers" | "whisker guard" | "whisker hunt" | "whisker operators" | "whisker table" | "whisker rules" | "whisker rules compile" | "whisker rules show" | "whisker rules evaluate" | "whisker rules table" | "whisker rules compare" | "whisker rules search" | "whisker figures" | "whisker plant" | "whisker controller" | "whisker hil" | "whisker bench" | "whisker bench nodes" | "whisker bench watch" | "whisker bench record" | "whisker bench get" | "whisker bench set" | "whisker bench save" | "whisker bench restore" | "whisker bench rules" | "whisker bench stop" | "whisker bench reset" | "whisker bench cancel" | "whisker bench goal" | "whisker bench drive" | "whisker bench calibrate" | "whisker replay" | "whisker socket" | "whisker dbc" | "whisker protocol") path+=" $word" ;;
    esac
  done
  case $path in
    "whisker")
      options="-h --help --version" words="run world robot campaign scanner movers guard hunt operators table rules figures plant controller hil bench replay socket dbc protocol" paths=none
      ;;
    "whisker run")
      options="-h --help --robot --seed --trace --svg --html --json --planner --map-bytes --rules --map" words="" paths=file
      case $before in
        --robot | --trace | --svg | --html | --rules) options="" words="" paths=file ;;
        --seed | --map) options="" words="" paths=value ;;
        --planner) options="" words="skirt boundary thesis map bug2 distbug wall-follower fan repulsion" paths=value ;;
        --map-bytes) options="" words="1024 2048 4096 8192 16384" paths=value ;;
      esac
      ;;
    "whisker world")
      options="-h --help --seed --discs --width --box --noise --wheel-scale-sigma --out" words="discs poles u-trap spiral maze rooms enclosed enclosed-at-wall gap-at-wall contest-maze gap disc-gap" paths=none
      case $before in
        --seed | --discs | --width | --wheel-scale-sigma) options="" words="" paths=value ;;
        --out) options="" words="" paths=file ;;
      esac
      ;;
    "whisker robot")
      options="-h --help" words="check layout calibrate calibrate-drive" paths=none
      ;;
    "whisker robot check")
      options="-h --help --header --planner --map-bytes --rules --map --json" words="" paths=file
      case $before in
        --header | --rules) options="" words="" paths=file ;;
        --planner) options="" words="skirt boundary thesis map bug2 distbug wall-follower fan repulsion" paths=value ;;
        --map-bytes) options="" words="1024 2048 4096 8192 16384" paths=value ;;
        --map) options="" words="" paths=value ;;
      esac
      ;;
    "whisker robot layout")
      options="-h --help --sensor --body --clear --robot --angles --count --seed --planner --map-bytes --rules --map --jobs --svg --json --out" words="" paths=none
      case $before in
        --sensor | --body | --clear | --angles | --count | --seed | --map | --jobs) options="" words="" paths=value ;;
        --robot | --rules | --svg | --out) options="" words="" paths=file ;;
        --planner) options="" words="skirt boundary thesis map bug2 distbug wall-follower fan repulsion" paths=value ;;
        --map-bytes) options="" words="1024 2048 4096 8192 16384" paths=value ;;
      esac
      ;;
    "whisker robot calibrate")
      options="-h --help --log --node --record --drop --can --realtime --wall-heading --true --distance --along --turned --sigma --dropout --false-clear --phantom --wheel-scale-sigma --seed --count --jobs --trace --json" words="" paths=file
      case $before in
        --log | --record | --true | --trace) options="" words="" paths=file ;;
        --node | --drop | --can | --wall-heading | --distance | --along | --turned | --sigma | --dropout | --false-clear | --phantom | --wheel-scale-sigma | --seed | --count | --jobs) options="" words="" paths=value ;;
      esac
      ;;
    "whisker robot calibrate-drive")
      options="-h --help --tape --square-ends --side --true --scene --noise --straight --squares --seed --count --jobs --node --record --drop --can --realtime --mission --svg --json" words="" paths=file
      case $before in
        --tape | --side | --scene | --straight | --squares | --seed | --count | --jobs | --node | --drop | --can | --mission) options="" words="" paths=value ;;
        --square-ends | --true | --record | --svg) options="" words="" paths=file ;;
      esac
      ;;
    "whisker campaign")
      options="-h --help --count --seed --discs --width --box --noise --wheel-scale-sigma --planner --map-bytes --rules --map --robot --robots --jobs --shard --csv --save-failures --json --merge --replay --svg --trace --html" words="" paths=folder
      case $before in
        --count | --seed | --discs | --width | --wheel-scale-sigma | --map | --jobs | --shard | --replay) options="" words="" paths=value ;;
        --planner) options="" words="skirt boundary thesis map bug2 distbug wall-follower fan repulsion" paths=value ;;
        --map-bytes) options="" words="1024 2048 4096 8192 16384" paths=value ;;
        --rules | --robot | --csv | --merge | --svg | --trace | --html) options="" words="" paths=file ;;
        --robots) options="" words="random" paths=value ;;
        --save-failures) options="" words="" paths=folder ;;
      esac
      ;;
    "whisker scanner")
      options="-h --help --count --seed --discs --width --box --jobs --json" words="" paths=folder
      case $before in
        --count | --seed | --discs | --width | --jobs) options="" words="" paths=value ;;
      esac
      ;;
    "whisker movers")
      options="-h --help --count --seed --planner --map-bytes --rules --map --robot --contacts" words="" paths=none
      case $before in
        --count | --seed | --map) options="" words="" paths=value ;;
        --planner) options="" words="skirt boundary thesis map bug2 distbug wall-follower fan repulsion" paths=value ;;
        --map-bytes) options="" words="1024 2048 4096 8192 16384" paths=value ;;
        --rules | --robot) options="" words="" paths=file ;;
        --contacts) options="" words="" paths=folder ;;
      esac
      ;;
    "whisker guard")
      options="-h --help --robot --commands --keys --operator --seed --vouch --time --bare --rules --map --trace --html --json" words="" paths=file
      case $before in
        --robot | --commands | --rules | --trace | --html) options="" words="" paths=file ;;
        --operator | --seed | --vouch | --time | --map) options="" words="" paths=value ;;
      esac
      ;;
    "whisker hunt")
      options="-h --help --count --time --seed --jobs --shard --out --again --case --summary" words="" paths=none
      case $before in
        --count | --time | --seed | --jobs | --shard | --again) options="" words="" paths=value ;;
        --out) options="" words="" paths=folder ;;
        --case | --summary) options="" words="" paths=file ;;
      esac
      ;;
    "whisker operators")
      options="-h --help --count --seed --operator --hostile --noise --robot --rules --map" words="" paths=none
      case $before in
        --count | --seed | --operator | --hostile | --map) options="" words="" paths=value ;;
        --robot | --rules) options="" words="" paths=file ;;
      esac
      ;;
    "whisker table")
      options="-h --help --csv --svg" words="" paths=none
      case $before in
        --svg) options="" words="" paths=file ;;
      esac
      ;;
    "whisker rules")
      options="-h --help" words="compile show evaluate table compare search" paths=none
      ;;
    "whisker rules compile")
      options="-h --help --tolerance --max-bytes --nodes --fix --steps --header --svg --json" words="" paths=file
      case $before in
        --tolerance | --max-bytes | --nodes | --fix | --steps) options="" words="" paths=value ;;
        --header | --svg) options="" words="" paths=file ;;
      esac
      ;;
    "whisker rules show")
      options="-h --help --fix --svg --html" words="" paths=file
      case $before in
        --fix) options="" words="" paths=value ;;
        --svg | --html) options="" words="" paths=file ;;
      esac
      ;;
    "whisker rules evaluate")
      options="-h --help" words="" paths=file
      ;;
    "whisker rules table")
      options="-h --help --map --out" words="" paths=file
      case $before in
        --map) options="" words="" paths=value ;;
        --out) options="" words="" paths=file ;;
      esac
      ;;
    "whisker rules compare")
      options="-h --help --map --worlds --count --seed --discs --width --box --noise --planner --map-bytes --robot --jobs --json" words="" paths=file
      case $before in
        --map | --count | --seed | --discs | --width | --jobs) options="" words="" paths=value ;;
        --worlds) options="" words="" paths=folder ;;
        --planner) options="" words="skirt boundary thesis map bug2 distbug wall-follower fan repulsion" paths=value ;;
        --map-bytes) options="" words="1024 2048 4096 8192 16384" paths=value ;;
        --robot) options="" words="" paths=file ;;
      esac
      ;;
    "whisker rules search")
      options="-h --help --base --worlds --count --seed --generations --children --validate --assist --discs --width --box --noise --planner --map-bytes --robot --jobs --out --json" words="" paths=none
      case $before in
        --base | --robot | --out) options="" words="" paths=file ;;
        --worlds | --count | --seed | --generations | --children | --validate | --discs | --width | --jobs) options="" words="" paths=value ;;
        --planner) options="" words="skirt boundary thesis map bug2 distbug wall-follower fan repulsion" paths=value ;;
        --map-bytes) options="" words="1024 2048 4096 8192 16384" paths=value ;;
      esac
      ;;
    "whisker figures")
      options="-h --help --scenarios" words="" paths=folder
      case $before in
        --scenarios) options="" words="" paths=file ;;
      esac
      ;;
    "whisker plant")
      options="-h --help --robot --seed --trace --svg --html --json --node --record --drop --can --realtime --rules --map --calibrate --view --view-address --view-stay" words="" paths=file
      case $before in
        --robot | --trace | --svg | --html | --record | --rules) options="" words="" paths=file ;;
        --seed | --node | --drop | --can | --map | --calibrate | --view | --view-address) options="" words="" paths=value ;;
      esac
      ;;
    "whisker controller")
      options="-h --help --node --record --drop --can --planner --map-bytes --rules --map --guard --command-timeout --keep --calibration --realtime" words="" paths=none
      case $before in
        --node | --drop | --can | --map | --command-timeout) options="" words="" paths=value ;;
        --record | --rules | --keep | --calibration) options="" words="" paths=file ;;
        --planner) options="" words="skirt boundary thesis map bug2 distbug wall-follower fan repulsion" paths=value ;;
        --map-bytes) options="" words="1024 2048 4096 8192 16384" paths=value ;;
      esac
      ;;
    "whisker hil")
      options="-h --help --robot --seed --trace --svg --html --json --node --record --drop --can --planner --map-bytes --rules --map --realtime --view --view-address --view-stay" words="" paths=file
      case $before in
        --robot | --trace | --svg | --html | --record | --rules) options="" words="" paths=file ;;
        --seed | --node | --drop | --can | --map | --view | --view-address) options="" words="" paths=value ;;
        --planner) options="" words="skirt boundary thesis map bug2 distbug wall-follower fan repulsion" paths=value ;;
        --map-bytes) options="" words="1024 2048 4096 8192 16384" paths=value ;;
      esac
      ;;
    "whisker bench")
      options="-h --help" words="nodes watch record get set save restore rules stop reset cancel goal drive calibrate" paths=none
      ;;
    "whisker bench nodes")
      options="-h --help --can --tty --socket --timeout --drop --for --json" words="" paths=none
      case $before in
        --can | --tty | --timeout | --drop | --for) options="" words="" paths=value ;;
        --socket) options="" words="" paths=file ;;
      esac
      ;;
    "whisker bench watch")
      options="-h --help --can --tty --socket --timeout --drop --node --for --every --robot --view --view-address --view-stay --json" words="" paths=none
      case $before in
        --can | --tty | --timeout | --drop | --node | --for | --every | --view | --view-address) options="" words="" paths=value ;;
        --socket | --robot) options="" words="" paths=file ;;
      esac
      ;;
    "whisker bench record")
      options="-h --help --can --tty --socket --timeout --drop --node --for" words="" paths=file
      case $before in
        --can | --tty | --timeout | --drop | --node | --for) options="" words="" paths=value ;;
        --socket) options="" words="" paths=file ;;
      esac
      ;;
    "whisker bench get")
      options="-h --help --can --tty --socket --timeout --drop --node --all --json" words="" paths=none
      case $before in
        --can | --tty | --timeout | --drop | --node) options="" words="" paths=value ;;
        --socket) options="" words="" paths=file ;;
      esac
      ;;
    "whisker bench set")
      options="-h --help --can --tty --socket --timeout --drop --node --json" words="" paths=none
      case $before in
        --can | --tty | --timeout | --drop | --node) options="" words="" paths=value ;;
        --socket) options="" words="" paths=file ;;
      esac
      ;;
    "whisker bench save")
      options="-h --help --can --tty --socket --timeout --drop --node" words="" paths=file
      case $before in
        --can | --tty | --timeout | --drop | --node) options="" words="" paths=value ;;
        --socket) options="" words="" paths=file ;;
      esac
      ;;
    "whisker bench restore")
      options="-h --help --can --tty --socket --timeout --drop --node --json" words="" paths=file
      case $before in
        --can | --tty | --timeout | --drop | --node) options="" words="" paths=value ;;
        --socket) options="" words="" paths=file ;;
      esac
      ;;
    "whisker bench rules")
      options="-h --help --can --tty --socket --timeout --drop --node --map --restore --json" words="" paths=file
      case $before in
        --can | --tty | --timeout | --drop | --node | --map) options="" words="" paths=value ;;
        --socket) options="" words="" paths=file ;;
      esac
      ;;
    "whisker bench stop")
      options="-h --help --can --tty --socket --timeout --drop --node" words="" paths=none
      case $before in
        --can | --tty | --timeout | --drop | --node) options="" words="" paths=value ;;
        --socket) options="" words="" paths=file ;;
      esac
      ;;
    "whisker bench reset")
      options="-h --help --can --tty --socket --timeout --drop --node" words="" paths=none
      case $before in
        --can | --tty | --timeout | --drop | --node) options="" words="" paths=value ;;
        --socket) options="" words="" paths=file ;;
      esac
      ;;
    "whisker bench cancel")
      options="-h --help --can --tty --socket --timeout --drop --node" words="" paths=none
      case $before in
        --can | --tty | --timeout | --drop | --node) options="" words="" paths=value ;;
        --socket) options="" words="" paths=file ;;
      esac
      ;;
    "whisker bench goal")
      options="-h --help --can --tty --socket --timeout --drop --node --tolerance --for --planner --map-bytes --rules --map --view --view-address --view-stay --json" words="" paths=none
      case $before in
        --can | --tty | --timeout | --drop | --node | --tolerance | --for | --map | --view | --view-address) options="" words="" paths=value ;;
        --socket | --rules) options="" words="" paths=file ;;
        --planner) options="" words="skirt boundary thesis map bug2 distbug wall-follower fan repulsion" paths=value ;;
        --map-bytes) options="" words="1024 2048 4096 8192 16384" paths=value ;;
      esac
      ;;
    "whisker bench drive")
      options="-h --help --can --tty --socket --timeout --drop --node --keys --commands --speed --turn --vouch --for --json" words="" paths=none
      case $before in
        --can | --tty | --timeout | --drop | --node | --speed | --turn | --vouch | --for) options="" words="" paths=value ;;
        --socket | --commands) options="" words="" paths=file ;;
      esac
      ;;
    "whisker bench calibrate")
      options="-h --help --can --tty --socket --timeout --drop --node --length --for --json" words="" paths=none
      case $before in
        --can | --tty | --timeout | --drop | --node | --length | --for) options="" words="" paths=value ;;
        --socket) options="" words="" paths=file ;;
      esac
      ;;
    "whisker replay")
      options="-h --help --node --planner --map-bytes --rules --map --trace --html --json" words="" paths=file
      case $before in
        --node | --map) options="" words="" paths=value ;;
        --planner) options="" words="skirt boundary thesis map bug2 distbug wall-follower fan repulsion" paths=value ;;
        --map-bytes) options="" words="1024 2048 4096 8192 16384" paths=value ;;
        --rules | --trace | --html) options="" words="" paths=file ;;
      esac
      ;;
    "whisker socket")
      options="-h --help --tcp --udp --stdio --address --robot --planner --map-bytes --rules --map --timeout --json" words="" paths=none
      case $before in
        --tcp | --udp | --address | --map | --timeout) options="" words="" paths=value ;;
        --robot | --rules) options="" words="" paths=file ;;
        --planner) options="" words="skirt boundary thesis map bug2 distbug wall-follower fan repulsion" paths=value ;;
        --map-bytes) options="" words="1024 2048 4096 8192 16384" paths=value ;;
      esac
      ;;
    "whisker dbc")
      options="-h --help --robot" words="" paths=none
      case $before in
        --robot) options="" words="" paths=value ;;
      esac
      ;;
    "whisker protocol")
      options="-h --help --parameters" words="" paths=none
      ;;
  esac
  [[ $here == -* ]] && words=$options
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$here")
  [[ $here == -* ]] && return
  case $paths in
    file) mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$here") ;;
    folder) mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -d -- "$here") ;;
  esac
}
complete -o filenames -F _whisker whisker
