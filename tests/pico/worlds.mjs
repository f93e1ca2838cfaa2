import {join} from 'node:path';
import {ROOT} from '../../host/harness/pico/paths.mjs';

export const ROBOT = join(ROOT, 'host/robots/pico.toml');
export const world = (name) => join(ROOT, `tests/pico/worlds/${name}.toml`);
