import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

export const ROOT = join(dirname(fileURLToPath(import.meta.url)), '../../..');
export const IMAGE = process.env.WHISKER_UF2 ?? join(ROOT, 'build/pico/whisker.uf2');
