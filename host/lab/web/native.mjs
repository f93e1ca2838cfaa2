// Records the hashes of native runs that the playground compares with. usage: node native.mjs
// The command is $WHISKER, or build/host/whisker.
import {writeFileSync} from 'node:fs';
import {fileURLToPath} from 'node:url';
import {nativeHashes} from '../../../tests/web/native.mjs';

const path = fileURLToPath(new URL('src/playground/native.json', import.meta.url));
writeFileSync(path, `${JSON.stringify(nativeHashes(), null, 2)}\n`);
