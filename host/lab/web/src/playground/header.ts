/** The look-up table in the form of firmware/fuzzy/response_table.hpp; with the default rules, byte for byte that file. */
import type {Table} from './core.ts';

const LOW = {d: 128, r: -896};
const Q7 = 128;

function axis({columns, spacing}: Table): string {
  const values = Array.from({length: columns}, (_, i) => ((LOW.r + spacing[1] * i) / Q7).toFixed(2));
  return `    //  R =${values.map((v, i) => ` ${v.padStart(i === 0 ? 6 : 15)}`).join('')}`;
}

function row(table: Table, d: number): string {
  const {columns, spacing, nodes} = table;
  const number = (i: number) => String(nodes[i]).padStart(6);
  const texts = Array.from({length: columns}, (_, r) => {
    const at = 2 * (d * columns + r);
    return `{${number(at)},${number(at + 1)}}`;
  });
  return `    {${texts.join(',')}},  // D = ${((LOW.d + spacing[0] * d) / Q7).toFixed(2)}`;
}

/** `note` names the rules if they are not the default ones. */
export function tableHeader(table: Table, note: string | null): string {
  const origin = note
    ? [`/// The answers at the nodes of the look-up: {SA, SD}, raw Q14. ${note}`]
    : [
        '/// The exact answers of firmware/fuzzy/rules.hpp at the nodes of the look-up: {SA, SD}, raw Q14.',
        '/// Written by whisker_generate_table; edit the rules, not this file.',
      ];
  return [
    ...origin,
    '#pragma once',
    '',
    '#include "firmware/fuzzy/bilinear.hpp"',
    '',
    'namespace whisker::fuzzy {',
    '',
    '// clang-format off',
    'inline constexpr Bilinear::Table kResponseTable = {{',
    axis(table),
    ...Array.from({length: table.rows}, (_, d) => row(table, d)),
    '}};',
    '// clang-format on',
    '',
    '}  // namespace whisker::fuzzy',
    '',
  ].join('\n');
}
