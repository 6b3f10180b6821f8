# complete.zsh LINE: what an interactive zsh makes of the line when Tab is pressed.
zmodload zsh/zpty
zpty -b shell zsh -f -i
zpty -w shell "PS1=; autoload -U compinit; compinit -u; echo re''ady"
typeset seen
repeat 100 { zpty -r -t shell part && seen+=$part; [[ $seen == *ready* ]] && break; sleep 0.1 }
zpty -w -n shell "$1"$'\t'
repeat 30 { sleep 0.1; zpty -r -t shell part && print -rn -- $part }
zpty -d shell
