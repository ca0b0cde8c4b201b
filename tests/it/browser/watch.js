window.faults = []; addEventListener('error', e => faults.push(e.message));
addEventListener('securitypolicyviolation', e => faults.push('blocked ' + e.blockedURI)); console.error = m => 
faults.push(String(m));
const tell = found => console.log('found ' + JSON.stringify({ ...found, faults }));
const later = (ready, then) => { const started = performance.now(), wait = setInterval(() => {
if (ready() || performance.now() - started > 60000) { clearInterval(wait); then(); } }, 100); };
