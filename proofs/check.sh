#!/usr/bin/env bash
# Checks every bound of this folder, and that none is proven within 20 seconds when it is made a tenth smaller; then the
# theorems, which may rest on no axiom but those of Coq's real numbers. Needs Debian's packages gappa, coq and libcoq-interval.
set -euo pipefail
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# FILE SECONDS
holds() {
    [ "$1" -ef "$work/goal.${1##*.}" ] || cp "$1" "$work/goal.${1##*.}"
    case $1 in
        *.g) timeout "$2" gappa "$work/goal.g" ;;
        *.v) coqc -q "$work/goal.v" ;;
    esac >"$work/log" 2>&1
}

# Writes FILE with the bound of this number, counted from 1, a tenth smaller; fails where there is none.
tightened() {
    perl -0777 -e '
        my ($number, $text) = ($ARGV[0], do { local (@ARGV) = $ARGV[1]; <> });
        my ($head, $goal) = $text =~ /^(.*?(?:->|Goal))(.*)$/s;
        my ($seen, $found) = (0, 0);
        my $is = sub { ++$seen == $number && ($found = 1) };
        if ($ARGV[1] =~ /g$/) {
            $goal =~ s{(in \[-)(\d+)b-(\d+), \2b-\3\]|(<= )(\d+)b-(\d+)}{
                !$is->() ? $& : defined $2
                ? sprintf("in [-%db-%d, %db-%d]", (230 * $2, $3 + 8) x 2)
                : sprintf("<= %db-%d", 230 * $5, $6 + 8) }ge;
        } else {
            $goal =~ s{(\) <= |- 1\) <= )(\d+)/(\d+)}{ $is->() ? "$1${\(9 * $2)}/${\(10 * $3)}" : $& }ge;
        }
        exit 1 unless $found;
        print $head, $goal;' "$1" "$2"
}

for file in *.g *.v; do
    start=$(date +%s%N)
    holds "$file" 300 || { cat "$work/log"; echo "$file is not proven"; exit 1; }
    number=1
    while tightened "$number" "$file" >"$work/tight.${file##*.}"; do
        if holds "$work/tight.${file##*.}" 20; then
            echo "$file: bound $number is more than a tenth too large"
            exit 1
        fi
        number=$((number + 1))
    done
    [ "$number" -gt 1 ] || { echo "$file has no bound"; exit 1; }
    echo "$file: $((number - 1)) bounds hold, and none a tenth smaller ($((($(date +%s%N) - start) / 1000000)) ms)"
done

for file in theorems/*.v; do
    start=$(date +%s%N)
    cp "$file" "$work/goal.v"
    # Lists what each theorem rests on.
    grep -oP '^Theorem \K\w+' "$file" | sed 's/.*/Print Assumptions &./' >>"$work/goal.v"
    holds "$work/goal.v" 300 || { cat "$work/log"; echo "$file is not proven"; exit 1; }
    others=$(grep -P '^[\w.]+( :|$)' "$work/log" |
        grep -vE '^(Axioms:|ClassicalDedekindReals\.|FunctionalExtensionality\.|Classical_Prop\.)' || true)
    [ -z "$others" ] || { echo "$file assumes $others"; exit 1; }
    theorems=$(grep -c '^Theorem' "$file")
    echo "$file: $theorems theorems hold ($((($(date +%s%N) - start) / 1000000)) ms)"
done
